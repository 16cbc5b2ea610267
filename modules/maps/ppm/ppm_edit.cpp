#include "modules/maps/ppm/ppm_edit.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "framework/core/error.hpp"
#include "framework/core/only_handle.hpp"
#include "modules/maps/ppm/chunk_edit.hpp"
#include "modules/maps/ppm/vertex_finder.hpp"
#include "modules/maps/ppm/vertex_normals.hpp"

namespace ppm {
namespace {

struct StagedFace {
  std::array<std::uint32_t, 3> id;
  std::uint8_t divisions;
  FaceEvidence evidence;
  bool settled;
  std::size_t first_texel;  // in Staged::texels
};
struct StagedMove {
  Eigen::Vector3f from, to;
};
struct ChunkChange {
  std::vector<std::uint32_t> removed;
  std::vector<NewFace> added;
};

void sort_by_id(std::vector<NewVertex>& vertices) {
  std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  auto end = std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
  vertices.erase(end, vertices.end());
}

/// By how many cells b is away from a.
int cell_distance(const Cell& a, const Cell& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

struct PpmEdit::Staged {
  std::unordered_map<std::uint32_t, Eigen::Vector3f> vertex;  // new and used ones, by id; never iterated
  std::vector<StagedFace> faces;
  TexelArrays texels;
  std::map<std::uint32_t, ChunkChange> chunks;  // by chunk number
  std::map<std::uint32_t, StagedMove> moves;    // by vertex id
};

/// One commit: its steps share the list of what has changed so far.
class PpmEdit::Commit {
 public:
  Commit(PpmMap& map, Staged& staged) : map_(map), staged_(staged) {}

  void run() {
    assign_faces();
    for (auto& [chunk, what] : staged_.chunks) change_faces(chunk, what);
    if (!staged_.moves.empty()) move_vertices();
    update_normals();
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (auto chunk : changed_) {
      Geometry& geometry = map_.table_.edit(chunk).geometry.write();
      geometry.id = next_geometry_id();
      geometry.shrink_to_fit();
    }
    map_.table_.shrink_to_fit();
  }

 private:
  Geometry& change(std::uint32_t chunk) {
    if (changed_.empty() || changed_.back() != chunk) changed_.push_back(chunk);
    return map_.table_.edit(chunk).geometry.write();
  }

  /// Each new face goes to the chunk of its centroid's cell, made where there is none.
  void assign_faces() {
    for (const auto& f : staged_.faces) {
      const auto &a = staged_.vertex.at(f.id[0]), &b = staged_.vertex.at(f.id[1]), &c = staged_.vertex.at(f.id[2]);
      const Cell cell = map_.cell_of((a + b + c) / 3.0f);
      for (const auto* p : {&a, &b, &c}) extend_reach(cell, *p);
      auto chunk = map_.table_.find(cell);
      if (chunk == ChunkTable<PpmChunk>::kNone)
        chunk = map_.table_.add(cell, {Cow<Geometry>::make(), Cow<Texels>::make()});
      staged_.chunks[chunk].added.push_back(
          {f.id, f.divisions, f.evidence, staged_.texels.view(f.first_texel, texel_count(f.divisions)),
           f.settled});
    }
  }

  void extend_reach(const Cell& cell, const Eigen::Vector3f& p) {
    map_.reach_ = std::max(map_.reach_, cell_distance(cell, map_.cell_of(p)));
  }

  void change_faces(std::uint32_t chunk, ChunkChange& what) {
    std::sort(what.removed.begin(), what.removed.end());
    what.removed.erase(std::unique(what.removed.begin(), what.removed.end()), what.removed.end());
    Geometry& geometry = change(chunk);
    Texels& texels = map_.table_.edit(chunk).texels.write();
    for (auto f : what.removed)
      for (auto v : geometry.face[f]) touched_.push_back({geometry.vertex_id[v], geometry.position[v]});
    remove_faces(geometry, texels, what.removed);

    std::vector<NewVertex> vertices;
    for (const auto& f : what.added)
      for (auto id : f.id) {
        touched_.push_back({id, staged_.vertex.at(id)});
        if (geometry.find_vertex(id) == Geometry::kNoVertex) vertices.push_back(touched_.back());
      }
    sort_by_id(vertices);
    insert_vertices(geometry, vertices);
    append_faces(geometry, texels, what.added);
    if (!what.removed.empty()) drop_unused_vertices(geometry);
    texels.shrink_to_fit();
    geometry.box = bounding_box(geometry);
  }

  void move_vertices() {
    std::vector<std::pair<VertexCopy, Eigen::Vector3f>> placed;
    VertexFinder finder(map_);
    for (const auto& [id, move] : staged_.moves)
      for (const auto& copy : finder.copies(id, move.from)) placed.push_back({copy, move.to});
    std::stable_sort(placed.begin(), placed.end(),
                     [](const auto& a, const auto& b) { return a.first.chunk < b.first.chunk; });

    for (auto& touched : touched_)
      if (auto it = staged_.moves.find(touched.id); it != staged_.moves.end()) touched.position = it->second.to;
    for (std::size_t begin = 0, end = 0; begin < placed.size(); begin = end) {
      const auto chunk = placed[begin].first.chunk;
      while (end < placed.size() && placed[end].first.chunk == chunk) ++end;
      Geometry& geometry = change(chunk);
      std::vector<bool> moved(geometry.position.size(), false);
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [copy, position] = placed[i];
        geometry.position[copy.vertex] = position;
        moved[copy.vertex] = true;
        extend_reach(map_.table_.cell(chunk), position);
      }
      geometry.box = bounding_box(geometry);
      touch_faces_around(geometry, moved);
    }
  }

  void touch_faces_around(const Geometry& geometry, const std::vector<bool>& moved) {
    for (const auto& face : geometry.face)
      if (moved[face[0]] || moved[face[1]] || moved[face[2]])
        for (auto v : face) touched_.push_back({geometry.vertex_id[v], geometry.position[v]});
  }

  void update_normals() {
    sort_by_id(touched_);
    for (const auto& [copy, normal] : vertex_normals(map_, touched_))
      if (map_.table_[copy.chunk].geometry->normal[copy.vertex] != normal)
        change(copy.chunk).normal[copy.vertex] = normal;
  }

  PpmMap& map_;
  Staged& staged_;
  std::vector<std::uint32_t> changed_;  // chunks; may repeat until the end
  std::vector<NewVertex> touched_;      // vertices whose normal may differ, with their new positions
};

PpmEdit::PpmEdit(std::shared_ptr<const PpmMap> map) : staged_(std::make_unique<Staged>()) {
  PPM_CHECK(map != nullptr, "an edit needs a map");
  if (is_only_handle(map)) {
    map_ = std::const_pointer_cast<PpmMap>(std::move(map));
  } else {
    map_ = std::make_shared<PpmMap>(*map);
  }
}

PpmEdit::~PpmEdit() = default;

Texels& PpmEdit::texels(std::uint32_t chunk) {
  PPM_CHECK(chunk < map_->table_.size(), "chunk {} of {}", chunk, map_->table_.size());
  return map_->table_.edit(chunk).texels.write();
}

std::uint32_t PpmEdit::add_vertex(const Eigen::Vector3f& position) {
  const auto id = map_->next_vertex_id_++;
  staged_->vertex.emplace(id, position);
  return id;
}

void PpmEdit::use_vertex(std::uint32_t id, const Eigen::Vector3f& position) {
  PPM_CHECK(id < map_->next_vertex_id_, "vertex {} of {}", id, map_->next_vertex_id_);
  staged_->vertex.emplace(id, position);
}

void PpmEdit::add_face(const std::array<std::uint32_t, 3>& ids, std::uint8_t divisions, const TexelView& texels,
                       FaceEvidence evidence, bool settled) {
  PPM_CHECK(divisions >= 1 && divisions <= map_->settings_.max_divisions, "{} divisions", divisions);
  const std::size_t count = texel_count(divisions);
  const auto channels = static_cast<std::size_t>(map_->settings_.color_channels);
  PPM_CHECK(texels.mean.size() == count && texels.variance.size() == count, "{} and {} texels for {} divisions",
            texels.mean.size(), texels.variance.size(), divisions);
  PPM_CHECK(texels.color.size() == channels * count && texels.color_variance.size() == (channels > 0 ? count : 0),
            "{} values of colour for {} texels with {} channels", texels.color.size(), count, channels);
  for (auto id : ids) PPM_CHECK(staged_->vertex.contains(id), "vertex {} is not of this session", id);
  staged_->faces.push_back({ids, divisions, evidence, settled, staged_->texels.size()});
  staged_->texels.append(texels);
}

void PpmEdit::remove_face(std::uint32_t chunk, std::uint32_t face) {
  PPM_CHECK(chunk < map_->table_.size() && face < map_->table_[chunk].geometry->face.size(), "chunk {} face {}", chunk,
            face);
  staged_->chunks[chunk].removed.push_back(face);
}

void PpmEdit::move_vertex(std::uint32_t chunk, std::uint32_t vertex, const Eigen::Vector3f& position) {
  PPM_CHECK(chunk < map_->table_.size() && vertex < map_->table_[chunk].geometry->position.size(), "chunk {} vertex {}",
            chunk, vertex);
  const Geometry& geometry = *map_->table_[chunk].geometry;
  staged_->moves[geometry.vertex_id[vertex]] = {geometry.position[vertex], position};
}

std::shared_ptr<const PpmMap> PpmEdit::commit() {
  PPM_CHECK(map_ != nullptr, "a session ends with its first commit");
  if (!staged_->faces.empty() || !staged_->chunks.empty() || !staged_->moves.empty()) Commit(*map_, *staged_).run();
#ifdef PPM_DEBUG
  map_->check();
#endif
  return std::move(map_);
}

}  // namespace ppm
