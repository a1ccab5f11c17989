# vm_embed_text(NAME FILE): writes NAME.cpp in the binary folder, where `const char* volumark::NAME()` gives the text of
# FILE. A change of FILE configures again.
function(vm_embed_text name file)
  get_filename_component(path ${file} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  # String literals are limited to 64 KiB by the standard: split at every 8,000 characters.
  string(LENGTH "${text}" length)
  set(literal "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 chunk)
    string(APPEND literal "R\"text(${chunk})text\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp.new
       "namespace volumark {\nconst char* ${name}();\nconst char* ${name}() {\n  return ${literal};\n}\n}  // namespace volumark\n")
  configure_file(${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp.new ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp COPYONLY)
endfunction()
