# ppm_add_plugin(NAME FILE [LIBRARIES...]): a module as a shared library NAME.so, to be loaded with `--plugin` or `plugins:`. FILE is the
# same source that ppm_add_module would build in. Works in this project's build and after find_package(ppm).
function(ppm_add_plugin name file)
  add_library(${name} MODULE ${file})
  set_target_properties(${name} PROPERTIES PREFIX "")
  target_compile_definitions(${name} PRIVATE PPM_PLUGIN)
  target_link_libraries(${name} PRIVATE ppm::framework ppm::maps ${ARGN})
endfunction()
