#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/vdb/vdb_file.hpp"
#include "modules/sinks/output_name.hpp"

namespace ppm {
namespace {

/// Writes the best particle's occupancy grid for other programs whenever the node runs.
class MapVdb final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.vdb"}, {}, {}}};

  MapVdb() { params_.add("file", file_).doc(kOutputNameDoc); }

  void tick(Context& context) override {
    const auto& map = static_cast<const VdbMap&>(*belief->map[belief->best()]);
    write_file(context.output(output_name(file_, context.frame())), vdb_file(map));
  }

 private:
  std::string file_ = "map.vdb";
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MapVdb>("sink.map_vdb",
                     "Writes the best particle's occupancy grid as an OpenVDB file: log-odds, and occupancy as a fog volume.",
                     "Museth, \"VDB: High-Resolution Sparse Volumes with Dynamic Topology\", ACM Transactions on "
                     "Graphics, 2013");
}
