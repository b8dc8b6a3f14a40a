# tanglebin_embed(TARGET NAME FILE): the bytes of a text file as tanglebin::embedded::NAME (report/embedded.hpp).
function(tanglebin_embed target name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} content)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/tanglebin/report/embedded.cpp.in ${source} @ONLY)
  # Every compiler here takes longer string literals than the standard's least.
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  target_sources(${target} PRIVATE ${source})
endfunction()

# A file of a JavaScript library that Debian packages.
function(tanglebin_find_javascript variable package file)
  find_file(${variable} ${file} PATHS /usr/share/javascript /usr/local/share/javascript NO_DEFAULT_PATH)
  if(NOT ${variable})
    message(FATAL_ERROR "${file} is missing (Debian: apt install ${package}, or scripts/setup)")
  endif()
endfunction()
