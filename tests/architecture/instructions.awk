# instructions.awk -v prefix=NAME: of what objdump -d says, each instruction once, as the assembler reads it, to
# NAME.s; the function where it was first found, on the same line of NAME.where.
BEGIN { FS = "\t" }

/^[0-9a-f]+ <.*>:$/ { where = substr($0, index($0, "<") + 1); sub(/>:$/, "", where) }

NF > 1 && $1 ~ /^ *[0-9a-f]+:$/ {
  said = $2
  sub(/ *[#<].*/, "", said)
  gsub(/-?0x[0-9a-f]+\(/, "8(", said)  # whatever the distance
  # What fills gaps and pads calls: prefixes that the assembler sets by itself, or not twice.
  sub(/^(data16 |cs |rex\.W )+/, "", said)
  # Wherever a jump goes.
  if (said ~ /^([a-z]+ )?(j[a-z]+|call)(,p[nt])? +[0-9a-f]+$/) sub(/[0-9a-f]+$/, ".", said)
  # A CPU without it takes it as bsf, and finds the same where any bit is set: compilers say it everywhere.
  sub(/^tzcnt /, "bsf ", said)
  if (seen[said]++) next
  print said >(prefix ".s")
  print where >(prefix ".where")
}
