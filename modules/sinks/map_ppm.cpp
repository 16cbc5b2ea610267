#include <string>

#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/ppm/ppm_file.hpp"
#include "modules/sinks/output_name.hpp"

namespace ppm {
namespace {

/// Saves the best particle's mesh map whole, to be loaded again, whenever the node runs.
class MapPpm final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.ppm"}, {}, {}}};

  MapPpm() { params_.add("file", file_).doc(kOutputNameDoc); }

  void tick(Context& context) override {
    const auto& map = static_cast<const PpmMap&>(*belief->map[belief->best()]);
    save_ppm(map, context.output(output_name(file_, context.frame())));
  }

 private:
  std::string file_ = "map.ppm";
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MapPpm>("sink.map_ppm", "Saves the best particle's mesh map, complete, so that it can be loaded again.",
                     "paper, section 3");
}
