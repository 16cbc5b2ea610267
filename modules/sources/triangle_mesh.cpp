#include "modules/sources/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "framework/core/error.hpp"
#include "modules/sources/file_bytes.hpp"
#include "modules/sources/number_file.hpp"
#include "modules/sources/ply_header.hpp"

namespace ppm {
namespace {

/// The numbers behind a header, one by one, as text or as bytes, and where they stand.
class Numbers {
 public:
  Numbers(const std::filesystem::path& file, std::string_view bytes, const PlyHeader& header)
      : file_(file), bytes_(bytes), ascii_(header.ascii), at_(header.body), start_(header.body), line_(header.body_line) {}

  double next(PlyType type) { return ascii_ ? next_word() : next_bytes(type); }
  [[noreturn]] void fail(const std::string& reason) const {
    if (ascii_) throw DataError(to_string(Place{file_.string(), line_, 1}), reason);
    throw DataError(file_.string(), fmt::format("byte {}: {}", start_, reason));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  double next_word() {
    for (; at_ < bytes_.size() && is_blank(bytes_[at_]); ++at_) line_ += bytes_[at_] == '\n';
    start_ = at_;
    while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
    if (start_ == at_) fail("the file ends early");
    const auto word = bytes_.substr(start_, at_ - start_);
    const auto value = parse_number(word);
    if (!value) fail(fmt::format("'{}' is no number", word));
    return *value;
  }
  double next_bytes(PlyType type) {
    start_ = at_;
    if (bytes_.size() - at_ < size_of(type)) fail("the file ends early");
    at_ += size_of(type);
    return ply_number(type, bytes_.data() + start_);
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  bool ascii_;
  std::size_t at_, start_;
  int line_;
};

class MeshReader {
 public:
  MeshReader(const std::filesystem::path& file, std::string_view bytes)
      : file_(file), header_(read_ply_header(file, bytes)), numbers_(file, bytes, header_) {}

  TriangleMesh read() {
    require("vertex", {"x", "y", "z"}, false);
    require("face", {"vertex_indices", "vertex_index"}, true);
    for (const PlyElement& element : header_.elements)
      for (std::uint64_t i = 0; i < element.count; ++i) read_one(element);
    if (mesh_.face.empty()) throw DataError(file_.string(), "holds no face");
    check_corners();
    return std::move(mesh_);
  }

 private:
  /// Refuses a file whose element lacks what a mesh needs: all of the names, or any of them.
  void require(const std::string& element, const std::vector<std::string>& names, bool any) const {
    const auto found = std::find_if(header_.elements.begin(), header_.elements.end(),
                                    [&](const PlyElement& e) { return e.name == element; });
    if (found == header_.elements.end()) throw DataError(file_.string(), fmt::format("has no element '{}'", element));
    std::size_t there = 0;
    for (const PlyProperty& p : found->properties)
      there += p.is_list == any && std::find(names.begin(), names.end(), p.name) != names.end();
    if (there < (any ? 1 : names.size()))
      throw DataError(file_.string(), fmt::format("the element '{}' lacks {}", element,
                                                  any ? "the list 'vertex_indices'" : "a coordinate (x, y, z)"));
  }

  void read_one(const PlyElement& element) {
    const bool vertex = element.name == "vertex", face = element.name == "face";
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    for (const PlyProperty& p : element.properties) {
      if (p.is_list) {
        read_list(p);
        if (face && (p.name == "vertex_indices" || p.name == "vertex_index")) add_fan();
        continue;
      }
      const double value = numbers_.next(p.type);
      if (vertex && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z')
        position[p.name[0] - 'x'] = static_cast<float>(value);
    }
    if (!vertex) return;
    if (!position.allFinite()) numbers_.fail("a vertex is not finite");
    mesh_.position.push_back(position);
  }

  void read_list(const PlyProperty& p) {
    const double count = numbers_.next(p.count_type);
    if (!(count >= 0) || count != std::floor(count)) numbers_.fail(fmt::format("{} is no length of a list", count));
    list_.clear();
    for (double i = 0; i < count; ++i) list_.push_back(numbers_.next(p.type));
  }

  void add_fan() {
    if (list_.size() < 3) numbers_.fail(fmt::format("a face has {} corners", list_.size()));
    for (const double index : list_)
      if (!(index >= 0 && index < 4294967296.0) || index != std::floor(index))
        numbers_.fail(fmt::format("{} is no number of a vertex", index));
    for (std::size_t k = 1; k + 1 < list_.size(); ++k)
      mesh_.face.push_back({static_cast<std::uint32_t>(list_[0]), static_cast<std::uint32_t>(list_[k]),
                            static_cast<std::uint32_t>(list_[k + 1])});
  }

  /// At the end, since faces may stand before vertices.
  void check_corners() const {
    for (std::size_t f = 0; f < mesh_.face.size(); ++f)
      for (const std::uint32_t v : mesh_.face[f])
        if (v >= mesh_.position.size())
          throw DataError(file_.string(), fmt::format("triangle {} names vertex {} of {}", f, v, mesh_.position.size()));
  }

  const std::filesystem::path& file_;
  PlyHeader header_;
  Numbers numbers_;
  std::vector<double> list_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_ply_mesh(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  return MeshReader(file, bytes).read();
}

}  // namespace ppm
