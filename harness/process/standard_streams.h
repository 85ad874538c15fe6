/// Standard input, output and error of the program.
#pragma once

#include <exception>
#include <string>

namespace stereobench::harness {

/// Opens /dev/null in place of each standard stream that is closed. Otherwise the next file or pipe would get
/// its number, and be mistaken for it. Writing to a standard output that was closed stays an error.
void open_standard_streams();

/// Writes out what is buffered for standard output.
/// @throws std::runtime_error with the cause when anything that was written to it did not arrive
void flush_standard_output();

/// Writes "stereobench: " and a line to standard error, for people.
void note(const std::string& line);

/// Writes "stereobench: " and what went wrong to standard error.
void complain(const std::exception& error);

}  // namespace stereobench::harness
