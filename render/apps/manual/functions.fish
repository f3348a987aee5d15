# Completes boule in fish.

# The files that end so, and folders; all files where none does.
function __boule_files
    set -l token (commandline -ct)
    string match -q -- '-*=*' $token; and set token (string replace -r '^[^=]*=' '' -- $token)
    set -l all (complete -C "__boule_no_command $token" | string replace -r '\t.*' '')
    set -l found
    for file in $all
        for ending in $argv
            string match -q -- "*$ending" $file; and set -a found $file
        end
    end
    set -q found[1]; or set found $all
    printf '%s\n' $found (string match -- '*/' $all) | sort -u
end

function __boule_in
    set -l words (commandline -opc)
    test (count $words) -ge 2; and test $words[2] = $argv[1]
end

function __boule_begins
    test (count (commandline -opc)) -eq 1
end

complete -c boule -f
