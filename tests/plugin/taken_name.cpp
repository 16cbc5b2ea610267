// A plug-in whose module has the name of a built-in one.
#include "framework/graph/registry.hpp"

namespace {
class Taken : public ppm::Module {
 public:
  void tick(ppm::Context&) override {}
};
}  // namespace

PPM_MODULES(r) {
  r.add<Taken>("motion.constant_velocity", "Is there already.", "A test.");
}
