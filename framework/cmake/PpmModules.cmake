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

# ppm_add_shipped_plugin(NAME PACKAGE PKG MODULES FILES... SOURCES FILES... LIBRARIES...): a plug-in that graphs name without a path
# (`plugins: [NAME]`), of modules that need a library which may be absent. MODULES: files with PPM_MODULES; SOURCES: what they use; all
# relative to modules/. PACKAGE: the Debian package of the library. Without LIBRARIES it is not built, and its name tells what is missing.
function(ppm_add_shipped_plugin name)
  cmake_parse_arguments(ARG "" "PACKAGE" "MODULES;SOURCES;LIBRARIES" ${ARGN})
  set(folder ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/ppm/plugins)
  file(WRITE ${folder}/${name}.package "${ARG_PACKAGE}\n")
  install(FILES ${folder}/${name}.package DESTINATION ${CMAKE_INSTALL_LIBDIR}/ppm/plugins)
  if(NOT ARG_LIBRARIES)
    message(STATUS "${ARG_PACKAGE} is not installed: plug-in '${name}' is not built")
    file(REMOVE ${folder}/${name}.so)
    set_property(GLOBAL PROPERTY PPM_UNBUILT_PLUGINS TRUE)
    return()
  endif()
  set(target ppm_plugin_${name})
  set(declarations "")
  set(calls "")
  foreach(file IN LISTS ARG_MODULES)
    string(REGEX REPLACE "[/.]" "_" entry "ppm_register_${file}")
    set_source_files_properties(${CMAKE_SOURCE_DIR}/modules/${file} PROPERTIES COMPILE_DEFINITIONS PPM_MODULE_ENTRY=${entry})
    string(APPEND declarations "void ${entry}(::ppm::Registry& r);\n")
    string(APPEND calls "  ${entry}(r);\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp @ONLY CONTENT
"// Generated: the modules of plug-in @name@.
#define PPM_PLUGIN
#include \"framework/graph/registry.hpp\"
@declarations@
PPM_MODULES(r) {
@calls@}
")
  list(TRANSFORM ARG_MODULES PREPEND ${CMAKE_SOURCE_DIR}/modules/)
  list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_SOURCE_DIR}/modules/)
  add_library(ppm_${name} STATIC ${ARG_SOURCES})  # for tests, too
  target_link_libraries(ppm_${name} PUBLIC ppm_framework ${ARG_LIBRARIES})
  add_library(${target} MODULE ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp ${ARG_MODULES})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${folder}
                        INSTALL_RPATH $ORIGIN/../..)
  target_link_libraries(${target} PRIVATE ppm_${name})
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/ppm/plugins)
  set_property(GLOBAL APPEND PROPERTY PPM_SHIPPED_PLUGINS ${name})
endfunction()

# ppm_module_sources(FILES...): code that modules use and that is no module itself, relative to modules/.
function(ppm_module_sources)
  foreach(file IN LISTS ARGN)
    target_sources(ppm_modules PRIVATE ${CMAKE_SOURCE_DIR}/modules/${file})
  endforeach()
endfunction()
