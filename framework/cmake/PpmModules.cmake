# ppm_add_module(FILE [LIBRARIES...]): one module, built in. The file is relative to modules/. Its PPM_MODULES function gets a name of
# its own, and the generated list of built-ins calls it.
function(ppm_add_module file)
  string(REGEX REPLACE "[/.]" "_" entry "ppm_register_${file}")
  target_sources(ppm_modules PRIVATE ${CMAKE_SOURCE_DIR}/modules/${file})
  set_source_files_properties(${CMAKE_SOURCE_DIR}/modules/${file} TARGET_DIRECTORY ppm_modules
                              PROPERTIES COMPILE_DEFINITIONS PPM_MODULE_ENTRY=${entry})
  if(ARGN)
    target_link_libraries(ppm_modules PRIVATE ${ARGN})
  endif()
  set_property(GLOBAL APPEND PROPERTY PPM_MODULE_ENTRIES ${entry})
endfunction()

# Writes the list of built-ins: void ppm::register_builtin(Registry&). Call after the last ppm_add_module.
function(ppm_finish_modules)
  get_property(entries GLOBAL PROPERTY PPM_MODULE_ENTRIES)
  set(declarations "")
  set(calls "")
  foreach(entry IN LISTS entries)
    string(APPEND declarations "void ${entry}(::ppm::Registry& r);\n")
    string(APPEND calls "  ${entry}(r);\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/builtin.cpp @ONLY CONTENT
"// Generated: every ppm_add_module of modules/CMakeLists.txt.
#include \"modules/builtin.hpp\"
#include \"framework/graph/registry.hpp\"
@declarations@
namespace ppm {
void register_builtin(Registry& r) {
@calls@}
}  // namespace ppm
")
  target_sources(ppm_modules PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/builtin.cpp)
endfunction()

# ppm_module_sources(FILES...): code that modules use and that is no module itself, relative to modules/.
function(ppm_module_sources)
  foreach(file IN LISTS ARGN)
    target_sources(ppm_modules PRIVATE ${CMAKE_SOURCE_DIR}/modules/${file})
  endforeach()
endfunction()
