# bash completion for pelagic(1): commands, options and values of the help texts

_pelagic() {
    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} help type= words=
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        words="$("$1" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p') --help --version"
    else
        help=$("$1" "$command" --help 2>/dev/null) || return
        # The type of the option's value, and the options of a word that is no value.
        type=$(sed -nE "s/^  (-., )?$previous ([^ ]+).*/\2/p; s/^  $previous, --[a-z-]+ ([^ ]+).*/\1/p" <<<"$help")
        words=$(sed -nE 's/^  (-., )?(--[a-z-]+).*/\2/p; s/^  (-.), .*/\1/p' <<<"$help")
        [[ $type || $word == -* ]] || type=$(sed -nE 's/^Usage: .*\[([^ ]*)\]$/\1/p;q' <<<"${help#*$'\n'}")
    fi
    case $type in
        FILE* | DIR*)
            compopt -o filenames 2>/dev/null || :
            type=${type:0:1}
            mapfile -t COMPREPLY < <(compgen "-${type,}" -- "$word")
            return
            ;;
        PRESET)
            words=$(tr -s '\n ' '  ' <<<"$help" | sed -nE 's/.*start from a preset: (.*), or beaufort-0 to beaufort-12.*/\1/p')
            words="${words//,/} $(echo beaufort-{0..12})"
            ;;
        *'|'*) words=${type//|/ } ;;
        ?*) words= ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}

complete -F _pelagic pelagic
