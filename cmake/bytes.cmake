# cmake -DIN=file -DOUT=file.inc -P bytes.cmake: the bytes of a file as elements of a C array.
file(READ ${IN} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)"
       "\\1\n" bytes "${bytes}")
file(WRITE ${OUT} "${bytes}\n")
