#include "framework/slam/belief_file.hpp"

#include <limits>
#include <unordered_map>

#include "framework/core/error.hpp"

// Records: the particles; the columns; the predictions; the kinds of map; then for each kind its maps, as the codec has them.

namespace ppm {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Distinct objects behind a column of handles, in the order of the first particle that has each.
template <class T>
struct Distinct {
  std::vector<const T*> objects;
  std::vector<std::uint32_t> number;  ///< by particle; kNone for a null handle

  explicit Distinct(const std::vector<std::shared_ptr<const T>>& handles) {
    std::unordered_map<const T*, std::uint32_t> seen{{nullptr, kNone}};
    for (const auto& handle : handles) {
      const auto [it, added] = seen.emplace(handle.get(), static_cast<std::uint32_t>(objects.size()));
      if (added) objects.push_back(handle.get());
      number.push_back(it->second);
    }
  }
};

/// The handles of the particles from the distinct ones.
template <class T>
std::vector<std::shared_ptr<const T>> spread(const std::vector<std::shared_ptr<const T>>& distinct,
                                             const std::vector<std::uint32_t>& number, const RecordReader& in) {
  std::vector<std::shared_ptr<const T>> handles;
  for (auto n : number) {
    if (n != kNone && n >= distinct.size()) in.fail("names what is not there");
    handles.push_back(n == kNone ? nullptr : distinct[n]);
  }
  return handles;
}

/// The maps of one kind, and their places among all distinct maps.
struct OneKind {
  std::vector<const Map*> maps;
  std::vector<std::uint32_t> place;
};

void save_columns(const ParticleSet& belief, RecordFileWriter& file) {
  RecordWriter out;
  out.add(static_cast<std::uint64_t>(belief.columns().size()));
  for (const auto& [name, column] : belief.columns()) {
    out.add(name);
    out.add(column->type_name());
    for (std::size_t i = 0; i < belief.size(); ++i) out.add(column->saved(i));
  }
  file.write(out);
}

ParticleSet::Columns load_columns(std::size_t particles, RecordFileReader& file) {
  auto in = file.next("the particles' columns");
  ParticleSet::Columns columns;
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    const auto name = in.take<std::string>();
    const auto type = in.take<std::string>();
    std::vector<std::string> values;
    for (std::size_t i = 0; i < particles; ++i) values.push_back(in.take<std::string>());
    columns[name] = std::make_unique<SavedColumn>(type, std::move(values), file.file(), name);
  }
  in.finish();
  return columns;
}

void save_predictions(const ParticleSet& belief, bool predictions, RecordFileWriter& file) {
  RecordWriter out;
  out.add(predictions);
  if (predictions) {
    const Distinct<Prediction> distinct(belief.prediction);
    out.add(static_cast<std::uint64_t>(distinct.objects.size()));
    for (const auto* prediction : distinct.objects) out.add(*prediction);
    out.add(distinct.number);
  }
  file.write(out);
}

std::vector<PredictionHandle> load_predictions(std::size_t particles, RecordFileReader& file) {
  auto in = file.next("the particles' predictions");
  std::vector<PredictionHandle> handles(particles);
  if (in.take<bool>()) {
    std::vector<PredictionHandle> distinct;
    for (auto n = in.take<std::uint64_t>(); n > 0; --n)
      distinct.push_back(std::make_shared<const Prediction>(in.take<Prediction>()));
    handles = spread(distinct, in.take<std::vector<std::uint32_t>>(), in);
  }
  in.finish();
  return handles;
}

void save_maps(const ParticleSet& belief, const MapCodecs& codecs, RecordFileWriter& file) {
  const Distinct<Map> distinct(belief.map);
  std::map<std::string, OneKind> kinds;
  for (std::size_t k = 0; k < distinct.objects.size(); ++k) {
    auto& kind = kinds[std::string(distinct.objects[k]->kind())];
    kind.maps.push_back(distinct.objects[k]);
    kind.place.push_back(static_cast<std::uint32_t>(k));
  }
  RecordWriter out;
  out.add(distinct.number);
  out.add(static_cast<std::uint64_t>(distinct.objects.size()));
  out.add(static_cast<std::uint64_t>(kinds.size()));
  for (const auto& [name, kind] : kinds) {
    if (!codecs.contains(name)) throw ConfigError({}, fmt::format("maps of kind '{}' cannot be kept in a checkpoint", name));
    out.add(name);
    out.add(kind.place);
  }
  file.write(out);
  for (const auto& [name, kind] : kinds) codecs.at(name)->save(kind.maps, file);
}

std::vector<MapHandle> load_maps(const MapCodecs& codecs, RecordFileReader& file) {
  auto in = file.next("the particles' maps");
  const auto number = in.take<std::vector<std::uint32_t>>();
  std::vector<MapHandle> distinct(in.take<std::uint64_t>());
  std::map<std::string, std::vector<std::uint32_t>> kinds;
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    const auto name = in.take<std::string>();
    kinds[name] = in.take<std::vector<std::uint32_t>>();
  }
  in.finish();
  for (const auto& [name, place] : kinds) {
    if (!codecs.contains(name)) in.fail(fmt::format("are of kind '{}', which this graph's modules do not know", name));
    const auto maps = codecs.at(name)->load(file);
    if (maps.size() != place.size()) in.fail("are not as many as they should be");
    for (std::size_t k = 0; k < maps.size(); ++k) distinct.at(place[k]) = maps[k];
  }
  return spread(distinct, number, in);
}

}  // namespace

void save_belief(const ParticleSet& belief, const MapCodecs& codecs, bool predictions, RecordFileWriter& file) {
  RecordWriter out;
  out.add(belief.pose);
  out.add(belief.log_weight);
  out.add(belief.T_map_world);
  out.add(belief.lost);
  save_paths(out, belief.trajectory);
  file.write(out);
  save_columns(belief, file);
  save_predictions(belief, predictions, file);
  save_maps(belief, codecs, file);
}

void load_belief(ParticleSet& belief, const MapCodecs& codecs, RecordFileReader& file) {
  auto in = file.next("the particles");
  ParticleSet read;
  in.take(read.pose);
  in.take(read.log_weight);
  in.take(read.T_map_world);
  in.take(read.lost);
  read.trajectory = load_paths(in);
  in.finish();
  read.set_columns(load_columns(read.size(), file));
  read.prediction = load_predictions(read.size(), file);
  read.map = load_maps(codecs, file);
  for (auto n : {read.log_weight.size(), read.trajectory.size(), read.prediction.size(), read.map.size()})
    if (n != read.size()) in.fail("are not as many in every column");
  belief = std::move(read);
}

}  // namespace ppm
