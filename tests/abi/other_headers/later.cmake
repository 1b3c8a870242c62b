# Headers to come: today's, in which every struct that grows has one field more.
#
#   cmake -DFROM=FOLDER -DTO=FOLDER -P later.cmake
foreach(header spherecloud.h spherecloud_capture.h)
  file(READ ${FROM}/${header} text)
  string(REGEX REPLACE "({\n  uint32_t struct_size;[^}]*)}" "\\1  uint64_t added_later;\n}" text "${text}")
  string(REGEX REPLACE "(struct sphc_localizer_observation {[^}]*)}" "\\1  uint64_t added_later;\n}" text "${text}")
  file(WRITE ${TO}/${header} "${text}")
endforeach()
