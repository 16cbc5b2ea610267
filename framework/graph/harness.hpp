#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "framework/core/parallel.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// One module under test, without a graph.
///   Harness h(registry, "weighting.gaussian", "{stride: 2}");
///   h.input("frame", frame); h.belief().init(...); h.tick();
/// Throws what the module throws; ConfigError for bad parameters.
class Harness {
 public:
  Harness(const Registry& registry, const std::string& module, const std::string& params_yaml = "{}", int threads = 1,
          std::uint64_t seed = 1, std::filesystem::path out_dir = {});
  template <class T>
  void input(const std::string& port, std::shared_ptr<const T> value) {
    *slot(PortDirection::in, port, typeid(T)) = std::move(value);
  }
  template <class T>
  std::shared_ptr<const T> output(const std::string& port) {
    return std::static_pointer_cast<const T>(*slot(PortDirection::out, port, typeid(T)));
  }
  /// The module that an input calls; it must outlive the harness.
  void use(const std::string& port, Module& called);
  ParticleSet& belief() { return belief_; }
  Module& module() { return *module_; }
  Context& context() { return context_; }
  /// Runs open() before the first call, then tick() for the next frame. False when the module said end of stream.
  bool tick();
  void close();
  /// The module's state as a checkpoint keeps it, and its way back: load() opens the module; the next tick() is that of frame
  /// `frames`.
  std::string save() const;
  void load(const std::string& state, std::int64_t frames);

 private:
  /// Throws InternalError where the module has no such port.
  std::shared_ptr<const void>* slot(PortDirection direction, const std::string& port, std::type_index type);
  Workers workers_;
  Log log_{LogLevel::warning};
  Metrics metrics_;
  Context context_;
  ParticleSet belief_;
  std::unique_ptr<Module> module_;
  std::map<std::pair<PortDirection, std::string>, std::shared_ptr<const void>> slots_;
  bool opened_ = false, ticked_ = false;
};

}  // namespace ppm
