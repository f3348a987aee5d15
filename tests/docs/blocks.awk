# The fenced blocks of documents as files: FOLDER/NUMBER.LANGUAGE, the first line "PAGE:LINE" of the
# block's first line. awk -v folder=FOLDER -f blocks.awk PAGE...
FNR == 1 { inside = 0 }
/^```/ {
  if (inside) {
    close(file)
    inside = 0
  } else if ($0 != "```") {
    inside = 1
    language = substr($0, 4)
    file = sprintf("%s/%03d.%s", folder, ++blocks, language)
    print FILENAME ":" (FNR + 1) >file
  } else {
    inside = 1
    file = "/dev/null"
  }
  next
}
inside { print >file }
