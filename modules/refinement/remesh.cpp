#include "modules/maps/ppm/remesh.hpp"

#include "framework/graph/registry.hpp"
#include "framework/roles/map_editor.hpp"

namespace {

using namespace ppm;

/// Inserts vertices into every particle's mesh where its texels say with certainty that a face should bend.
/// source   paper, section 4.3
/// metrics  bent (faces that asked for it), inserted (vertices) of the first particle
class Remesh final : public MapEditor {
 public:
  Remesh() : MapEditor({{"map.ppm"}, {}, {}}, EditReads::map) {
    add_where();
    add_how();
  }

  MapHandle edit(Context& context, std::size_t particle, MapHandle map, int) override {
    RemeshCounts counts;
    auto divided = remesh(std::static_pointer_cast<const PpmMap>(std::move(map)), settings_, &counts);
    if (particle == 0) {
      context.metric("bent", static_cast<double>(counts.bent));
      context.metric("inserted", static_cast<double>(counts.inserted));
    }
    return divided;
  }

 private:
  void add_where() {
    auto& bend = settings_.bend;
    params_.add_choice("error", bend.bend, {{"bend", true}, {"offset", false}})
        .doc(
            "What must be large: bend, the offset beyond what moving the face's corners could give, averaged over "
            "neighbouring texels; or the texel's offset from the face itself (the paper's form).");
    params_.add("error_sigmas", bend.sigmas)
        .range(0, 100)
        .doc("The error must be more than so many of the texel's standard deviations ...");
    params_.add("error_least", bend.least).unit("m").range(0, 10).doc("... and more than this.");
    params_.add("sigma_most", bend.sigma_most)
        .unit("m")
        .above(0)
        .doc("Texels with a larger standard deviation are not certain enough to ask for a vertex.");
  }
  void add_how() {
    params_.add_choice("split", settings_.form, {{"bisect", SplitForm::bisect}, {"insert", SplitForm::insert}})
        .doc(
            "Where the vertex goes: bisect divides the longest edge around the face in its middle, with both its "
            "faces, "
            "so that no slivers arise; insert divides the face into three where its error is largest (the paper's "
            "form).");
    params_.add("edge_least", settings_.edge_least)
        .unit("m")
        .range(0, 1000)
        .doc("Faces whose longest edge is shorter are left to their texels.");
    params_.add("turn_most", settings_.turn_most)
        .unit("rad")
        .range(0, 1.5)
        .doc("New faces turn no further from the one they replace; the vertex then goes less far.");
  }

  RemeshSettings settings_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Remesh>(
      "refinement.remesh",
      "Inserts vertices where the texels say with certainty that a face should bend, and divides the faces there.",
      "paper, section 4.3; Rivara, Int. J. Numer. Meth. Engng. 1997 (longest-edge bisection)");
}
