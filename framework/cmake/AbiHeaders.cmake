# Writes abi_headers.hpp: the version, and a hash over the public headers. Run as a script with SOURCE, OUTPUT and VERSION.
file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/framework/*.hpp ${SOURCE}/modules/maps/*.hpp)
list(SORT headers)
set(all "")
foreach(header IN LISTS headers)
  file(SHA256 ${SOURCE}/${header} hash)
  string(APPEND all "${header} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
file(WRITE ${OUTPUT} "#pragma once
#define PPM_VERSION \"${VERSION}\"
#define PPM_HEADERS_HASH \"${hash}\"
")
