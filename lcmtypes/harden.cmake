# Hardens one header made by lcm-gen against hostile sizes: cmake -D HEADER=FILE -P harden.cmake
#
# lcm-gen 1.3.1 resizes a vector to whatever the packet says (-1 aborts, 1e9 is allocated or crashes) and takes a
# string of length 0 or below. After this, a count below 0 or above the bytes that are left, a string length below 1
# (it includes the final NUL), and a string whose first NUL is not its last byte (it could not be sent on) make
# decode() return -1 before anything is allocated.
file(READ "${HEADER}" text)
string(REGEX REPLACE "(this->[][A-Za-z0-9_]+\\.resize\\((this->[A-Za-z0-9_]+)\\);)"
       "if(\\2 < 0 || \\2 > maxlen - pos) return -1;\n        \\1" text "${text}")
string(REGEX REPLACE "if\\((__[A-Za-z0-9_]+_len__) > maxlen - pos\\) return -1;"
       "if(\\1 < 1 || \\1 > maxlen - pos || strnlen((const char*)buf + offset + pos, \\1) != size_t(\\1 - 1)) return -1;"
       text "${text}")
# Optimisers cannot see that a failed read returns early, and warn.
string(REGEX REPLACE "(int64_t msg_hash|int32_t __[A-Za-z0-9_]+_len__);" "\\1 = 0;" text "${text}")
file(WRITE "${HEADER}" "${text}")
