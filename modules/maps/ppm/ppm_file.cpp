#include "modules/maps/ppm/ppm_file.hpp"

#include <bit>
#include <cstring>
#include <fstream>
#include <string>
#include <type_traits>

#include "framework/core/atomic_file.hpp"
#include "framework/core/digest.hpp"
#include "framework/core/error.hpp"
#include "modules/maps/ppm/chunk_edit.hpp"

static_assert(std::endian::native == std::endian::little,
              "map.ppm is little endian, and is written from memory as it is");

// Layout: magic, then records. A record is: u64 length of the payload, payload, 32 characters of its hash.
// First record: version, settings, vertex ids, number of chunks. Then one record a chunk. Derived parts of a chunk
// (open edges, box) are computed again.

namespace ppm {
namespace {

constexpr std::string_view kMagic = "PPMMAP\r\n";
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kHashLength = 32;
constexpr float kFarthest = 1e6f;  // m; of a coordinate

std::string hash_of(std::string_view payload) {
  Digest digest;
  digest.add(payload.data(), payload.size());
  return digest.hex();
}

class Payload {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void write(AtomicFile& file) const {
    const auto length = static_cast<std::uint64_t>(bytes_.size());
    file.write(&length, sizeof length);
    file.write(bytes_);
    file.write(hash_of(bytes_));
  }

 private:
  std::string bytes_;
};

/// Takes values off the front of a record.
class RecordView {
 public:
  RecordView(std::string_view bytes, const std::string& file, const std::string& what)
      : bytes_(bytes), file_(file), what_(what) {}

  template <class T>
  T take() {
    T value;
    std::memcpy(&value, need(sizeof value), sizeof value);
    return value;
  }
  template <class T>
  void take(std::vector<T>& values) {
    const auto count = take<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) fail("is shorter than its counts say");
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), need(count * sizeof(T)), count * sizeof(T));
  }
  void finish() const {
    if (!bytes_.empty()) fail("has bytes left over");
  }
  [[noreturn]] void fail(const std::string& reason) const { throw DataError(file_, what_ + " " + reason); }

 private:
  const char* need(std::size_t count) {
    if (count > bytes_.size()) fail("is shorter than its counts say");
    const char* data = bytes_.data();
    bytes_.remove_prefix(count);
    return data;
  }
  std::string_view bytes_;
  std::string file_, what_;
};

/// Takes records off a file that was read whole.
class RecordReader {
 public:
  explicit RecordReader(const std::filesystem::path& path) : file_(path.string()) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw DataError(file_, "cannot be opened");
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    if (in.bad()) throw DataError(file_, "cannot be read");
    const auto length = std::min(bytes_.size(), kMagic.size());
    if (std::string_view(bytes_).substr(0, length) != kMagic.substr(0, length))
      throw DataError(file_, "is not a map.ppm");
    at_ = kMagic.size();
    if (bytes_.size() < at_) throw DataError(file_, "is cut short");
  }

  RecordView next(const std::string& what) {
    const auto left = bytes_.size() - at_;
    std::uint64_t length = 0;
    if (left < sizeof length) cut(what);
    std::memcpy(&length, bytes_.data() + at_, sizeof length);
    const auto room = left - sizeof length;
    if (room < kHashLength || length > room - kHashLength) cut(what);
    const auto payload = std::string_view(bytes_).substr(at_ + sizeof length, length);
    const auto hash = std::string_view(bytes_).substr(at_ + sizeof length + length, kHashLength);
    if (hash_of(payload) != hash) throw DataError(file_, what + " was altered (its checksum differs)");
    at_ += sizeof length + length + kHashLength;
    return {payload, file_, what};
  }
  void finish() const {
    if (at_ != bytes_.size()) throw DataError(file_, "goes on after its last chunk");
  }
  const std::string& file() const { return file_; }

 private:
  [[noreturn]] void cut(const std::string& what) const { throw DataError(file_, "is cut short in " + what); }
  std::string file_;
  std::string bytes_;
  std::size_t at_ = 0;
};

void write_chunk(const PpmChunk& chunk, const Cell& cell, AtomicFile& file) {
  Payload payload;
  payload.add(std::array<std::int32_t, 3>{cell.x(), cell.y(), cell.z()});
  const Geometry& geometry = *chunk.geometry;
  payload.add(geometry.position);
  payload.add(geometry.normal);
  payload.add(geometry.vertex_id);
  payload.add(geometry.face);
  payload.add(geometry.divisions);
  payload.add(chunk.texels->mean);
  payload.add(chunk.texels->variance);
  payload.add(chunk.texels->color);
  payload.add(chunk.texels->color_variance);
  payload.add(chunk.texels->evidence);
  payload.write(file);
}

Geometry read_geometry(RecordView& record) {
  Geometry geometry;
  record.take(geometry.position);
  record.take(geometry.normal);
  record.take(geometry.vertex_id);
  record.take(geometry.face);
  record.take(geometry.divisions);
  if (geometry.normal.size() != geometry.position.size() || geometry.vertex_id.size() != geometry.position.size() ||
      geometry.divisions.size() != geometry.face.size())
    record.fail("has counts that do not fit");
  for (const auto& p : geometry.position)
    if (!(p.cwiseAbs().maxCoeff() < kFarthest)) record.fail("has a vertex that lies nowhere");
  std::uint32_t texel = 0;
  for (std::size_t f = 0; f < geometry.face.size(); ++f) {
    for (auto v : geometry.face[f])
      if (v >= geometry.position.size()) record.fail("has a face with a vertex that is not there");
    geometry.first_texel.push_back(texel);
    texel += texel_count(geometry.divisions[f]);
  }
  geometry.open_edge = open_edges(geometry);
  geometry.box = bounding_box(geometry);
  geometry.id = next_geometry_id();
  return geometry;
}

Texels read_texels(RecordView& record) {
  Texels texels;
  record.take(texels.mean);
  record.take(texels.variance);
  record.take(texels.color);
  record.take(texels.color_variance);
  record.take(texels.evidence);
  return texels;
}

}  // namespace

/// Builds a map from records.
class PpmReader {
 public:
  explicit PpmReader(const std::filesystem::path& path) : records_(path) {}

  std::shared_ptr<const PpmMap> read() {
    try {
      auto map = read_map();
      map->check();
      return map;
    } catch (const InternalError& error) {
      throw DataError(records_.file(), std::string("is not a sound map: ") + error.what());
    }
  }

 private:
  std::shared_ptr<PpmMap> read_map() {
    auto header = records_.next("the header");
    const auto version = header.take<std::uint32_t>();
    if (version != kVersion)
      header.fail(fmt::format("is of version {}; this program reads version {}", version, kVersion));
    PpmSettings settings;
    settings.cell_size_m = header.take<double>();
    settings.texel_size_m = header.take<double>();
    settings.prior_sigma_m = header.take<double>();
    settings.max_divisions = header.take<std::int32_t>();
    settings.color_channels = header.take<std::int32_t>();
    auto map = std::make_shared<PpmMap>(settings);
    map->next_vertex_id_ = header.take<std::uint32_t>();
    const auto chunks = header.take<std::uint64_t>();
    header.finish();
    for (std::uint64_t i = 0; i < chunks; ++i) read_chunk(*map, records_.next(fmt::format("chunk {}", i)));
    records_.finish();
    return map;
  }

  void read_chunk(PpmMap& map, RecordView record) {
    const auto cell = record.take<std::array<std::int32_t, 3>>();
    auto geometry = read_geometry(record);
    auto texels = read_texels(record);
    record.finish();
    const Cell at(cell[0], cell[1], cell[2]);
    if (map.table_.find(at) != ChunkTable<PpmChunk>::kNone) record.fail("lies in a cell that has one already");
    if (!geometry.box.isEmpty())
      for (const auto& corner : {geometry.box.min(), geometry.box.max()})
        map.reach_ = std::max(map.reach_, (map.cell_of(corner) - at).cwiseAbs().maxCoeff());
    map.table_.add(at, {Cow<Geometry>::make(std::move(geometry)), Cow<Texels>::make(std::move(texels))});
  }

  RecordReader records_;
};

void save_ppm(const PpmMap& map, const std::filesystem::path& path) {
  AtomicFile file(path);
  file.write(kMagic);
  Payload header;
  header.add(kVersion);
  header.add(map.settings().cell_size_m);
  header.add(map.settings().texel_size_m);
  header.add(map.settings().prior_sigma_m);
  header.add(static_cast<std::int32_t>(map.settings().max_divisions));
  header.add(static_cast<std::int32_t>(map.settings().color_channels));
  header.add(map.vertex_ids());
  header.add(static_cast<std::uint64_t>(map.table().size()));
  header.write(file);
  for (std::size_t i = 0; i < map.table().size(); ++i) write_chunk(map.table()[i], map.table().cell(i), file);
  file.commit();
}

std::shared_ptr<const PpmMap> load_ppm(const std::filesystem::path& path) {
  return PpmReader(path).read();
}

}  // namespace ppm
