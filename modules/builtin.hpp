#pragma once

namespace ppm {

class Registry;
/// Registers every module that was built in (ppm_add_module).
void register_builtin(Registry& registry);

}  // namespace ppm
