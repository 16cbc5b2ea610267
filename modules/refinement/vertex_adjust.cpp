#include "modules/maps/ppm/vertex_adjust.hpp"

#include "framework/graph/registry.hpp"
#include "framework/roles/map_editor.hpp"

namespace {

using namespace ppm;

enum class Texels { reexpress, keep };
enum class Mean { information, plain };
enum class Boundary { keep, move };

/// Moves vertices of every particle's mesh to where the texels around them say that the surface is.
/// source   paper, section 4.3
/// metrics  moved, refused (vertices), farthest (m) of the first particle
class VertexAdjust final : public MapEditor {
 public:
  VertexAdjust() : MapEditor({{"map.ppm"}, {}, {}}, EditReads::map) {
    add_threshold();
    add_form();
  }

  void before(Context&) override {
    settings_.weighted = mean_ == Mean::information;
    settings_.boundary = boundary_ == Boundary::move;
    settings_.reexpress = texels_ == Texels::reexpress;
  }

  MapHandle edit(Context& context, std::size_t particle, MapHandle map, int) override {
    AdjustCounts counts;
    auto adjusted = adjust_vertices(std::static_pointer_cast<const PpmMap>(std::move(map)), settings_, &counts);
    if (particle == 0) report(context, counts);
    return adjusted;
  }

 private:
  void add_threshold() {
    params_.add("offset_sigmas", settings_.sigmas)
        .range(0, 100)
        .doc("A vertex moves when the mean around it is more than so many of its standard deviations ...");
    params_.add("offset_least", settings_.least)
        .unit("m")
        .range(0, 10)
        .doc("... and more than this; with both 0 every vertex moves each time (the paper's form).");
    params_.add("step_most", settings_.most).unit("m").above(0).doc("Longest step of a vertex at once.");
    params_.add("turn_most", settings_.turn_most)
        .unit("rad")
        .range(0, 1.5)
        .doc("Where a face would turn by more than this, its vertices stay.");
  }
  void add_form() {
    params_.add("rings", settings_.rings)
        .range(0, 255)
        .doc("Texels up to so many steps from a vertex count as around it; 0 = those that lie on it.");
    params_.add_choice("mean", mean_, {{"information", Mean::information}, {"plain", Mean::plain}})
        .doc(
            "Of the texels around a vertex: weighted by their information and by how far their face's normal shows "
            "along "
            "the vertex's, or plain (the paper's form).");
    params_.add_choice("boundary", boundary_, {{"keep", Boundary::keep}, {"move", Boundary::move}})
        .doc("Whether vertices on the boundary of the mesh stay: texels on silhouettes are the least certain.");
    params_.add_choice("texels", texels_, {{"reexpress", Texels::reexpress}, {"keep", Texels::keep}})
        .doc(
            "What becomes of the texels' means: reexpress measures them from the faces as they are then, so that the "
            "described surface stays; keep leaves them as they are, and the surface moves with the vertices.");
  }
  static void report(Context& context, const AdjustCounts& counts) {
    context.metric("moved", static_cast<double>(counts.moved));
    context.metric("refused", static_cast<double>(counts.refused));
    context.metric("farthest", counts.farthest);
  }

  AdjustSettings settings_;
  Mean mean_ = Mean::information;
  Boundary boundary_ = Boundary::keep;
  Texels texels_ = Texels::reexpress;
};

}  // namespace

PPM_MODULES(r) {
  r.add<VertexAdjust>("refinement.vertex_adjust",
                      "Moves vertices along their normals to where the texels around them say that the surface is.",
                      "paper, section 4.3");
}
