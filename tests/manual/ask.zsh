# zsh -f ask.zsh FOLDER LINE...: what a zsh with the completion _boule of a folder shows when the key Tab
# is pressed behind each line: a line of words for each.
zmodload zsh/zpty
zpty shell zsh -f -i
folder="$1"
shift

# Reads until the shell says the word.
wait_for() {
  local part
  answer=''
  while zpty -r shell part; do
    answer+="$part"
    [[ "$answer" != *"$1"* ]] || return 0
  done
}

zpty -w shell "PROMPT='' RPROMPT='' TERM=dumb; unsetopt zle_bracketed_paste prompt_sp 2>/dev/null; stty -echo"
zpty -w shell "fpath=($folder \$fpath); autoload -U compinit; compinit -u -D"
# What _boule adds is printed instead of shown: words that begin as the last one does.
zpty -w shell '
LISTMAX=10000
show() {
  compadd() {
    local -a found words
    [[ "${@[(r)-[OAD]]}" == "" ]] || { builtin compadd "$@"; return }
    builtin compadd -O found "$@"
    print -rn -- "${(j: :)found} "
    builtin compadd "$@"
  }
  print -rn "BEGIN"
  _main_complete
  print -r "END"
  compstate[insert]="" compstate[list]=""
  unfunction compadd
}
zle -C show complete-word show
bindkey "^I" show
print READ""Y'
wait_for READY
for line in "$@"; do
  zpty -w -n shell "$line"$'\t'
  wait_for END
  print -r -- "${${answer##*BEGIN}%%END*}"
  zpty -w -n shell $'\x15'
done
zpty -d shell
