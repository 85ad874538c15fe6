# Completion of stereobench for bash. The program itself says how a command line may go on: a line for each word, with a
# blank behind it where it is whole, a tab, and what it is.
_stereobench() {
    local line=${COMP_LINE:0:COMP_POINT} breaks=${COMP_WORDBREAKS//[^=:]/} begun="" word entry words
    read -r -a words <<<"$line"
    [[ $line == *[[:space:]] ]] && words+=("")
    word=${words[-1]}
    if [[ $word == [\'\"]* ]]; then
        word=${word:1}
    elif [[ -n $breaks ]]; then # outside of quotes, bash replaces what stands behind these alone
        begun=${word%"${word##*["$breaks"]}"}
    fi
    words[-1]=$word
    COMPREPLY=()
    while IFS=$'\t' read -r entry _; do
        COMPREPLY+=("${entry#"$begun"}")
    done < <("$1" complete -- "${words[@]:1}" 2>/dev/null)
    [[ ${#COMPREPLY[@]} -eq 0 ]] || compopt -o nospace 2>/dev/null
}
complete -o default -o nosort -F _stereobench stereobench
