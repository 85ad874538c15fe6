# Makes the man pages of the program and of each of its commands from their help, and installs them.
# Read by cmake_install.cmake with: man_program, man_help2man, man_summary, man_folder (to make them in), man_epoch
# (seconds since 1970; the date that pages have unless SOURCE_DATE_EPOCH says another), man_destination.
string(RANDOM LENGTH 12 man_run)  # another install may be under way
set(man_folder ${man_folder}/${man_run})
file(MAKE_DIRECTORY ${man_folder}/programs)

if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  set(ENV{SOURCE_DATE_EPOCH} ${man_epoch})
endif()
set(ENV{LC_ALL} C.UTF-8)

# A page is called what its program is called: one that says the help of the command.
# @param name of the page
# @param command empty for the program itself
# @param says what it does, in a line
function(make_page name command says)
  set(page_program ${man_folder}/programs/${name})
  file(WRITE ${page_program}
       "#!/bin/sh\ncase \"$1\" in --version) exec '${man_program}' --version ;; esac\nexec '${man_program}' ${command} \"$@\"\n")
  file(CHMOD ${page_program} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  execute_process(COMMAND ${man_help2man} --no-info --section 1 --source stereobench --manual "stereobench"
                          --name ${says} --output ${man_folder}/${name}.1 ${page_program} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND gzip -9n ${man_folder}/${name}.1 COMMAND_ERROR_IS_FATAL ANY)
endfunction()

make_page(stereobench "" ${man_summary})
execute_process(COMMAND ${man_program} complete -- "" OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," lines "${lines}")
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([^ ]+) \t(.*)$" line "${line}")
  make_page(stereobench-${CMAKE_MATCH_1} ${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
endforeach()

file(GLOB pages ${man_folder}/*.1.gz)
file(INSTALL ${pages} DESTINATION ${man_destination})
file(REMOVE_RECURSE ${man_folder})
