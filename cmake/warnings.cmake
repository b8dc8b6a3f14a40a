# Strict warnings, all of them errors, for every target that the project compiles itself.
function(tanglebin_strict_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wnon-virtual-dtor
                                           -Wold-style-cast -Wundef -Werror)
  # Several sources are compiled at once (CMAKE_UNITY_BUILD). What one of them calls its own, another may call a local
  # variable; and types of an unnamed namespace in what is included are no mistake.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wshadow=local -Wno-subobject-linkage)
  endif()
  # GCC 12 warns of overlap inside std::string's own operator+ (GCC bug 105651, fixed in 13).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
endfunction()
