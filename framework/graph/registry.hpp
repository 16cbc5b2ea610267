#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/module.hpp"
#include "framework/slam/map_codec.hpp"

namespace ppm {

/// What is known of a module without making one.
struct ModuleInfo {
  std::string name;     ///< "category.name"
  std::string summary;  ///< one sentence
  std::string source;   ///< what it is after: "paper, section 4.2", "Sturm et al. 2012"
  std::string origin;   ///< "built in", or the plug-in's file
  std::function<std::unique_ptr<Module>()> make;
};

/// The modules that graphs can name. An ordinary object: filled by plain functions (PPM_MODULES), never by static
/// initialisers, which vanish from static archives.
class Registry {
 public:
  /// Throws InternalError for a malformed or taken name.
  template <class M>
  void add(const std::string& name, const std::string& summary, const std::string& source) {
    add(ModuleInfo{name, summary, source, origin_, [] { return std::make_unique<M>(); }});
  }
  void add(ModuleInfo info);
  /// Null where there is none.
  const ModuleInfo* find(const std::string& name) const;
  /// In alphabetical order.
  std::vector<const ModuleInfo*> all() const;
  std::vector<std::string> names() const;
  /// Says how maps of a kind are kept in checkpoints: called by one of the modules that make them. Throws InternalError
  /// where that was said already.
  template <class Codec>
  void add_map_kind(const std::string& kind) {
    add_map_kind(kind, std::make_shared<const Codec>());
  }
  void add_map_kind(const std::string& kind, std::shared_ptr<const MapCodec> codec);
  const MapCodecs& map_kinds() const { return map_kinds_; }
  /// What the following add() calls are recorded as.
  void set_origin(std::string origin) { origin_ = std::move(origin); }

 private:
  std::map<std::string, ModuleInfo> modules_;
  MapCodecs map_kinds_;
  std::string origin_ = "built in";
};

}  // namespace ppm

/// Opens the body of the one function of a module's file that registers it:
///   PPM_MODULES(r) { r.add<MyModule>("motion.mine", "What it does.", "Where it is from."); }
/// Built in, the build gives the function a name of its own and calls it (ppm_add_module defines PPM_MODULE_ENTRY); as
/// a plug-in (ppm_add_plugin defines PPM_PLUGIN) the same source exports it under a fixed name, with the ABI stamp of
/// the headers that it was compiled against.
#ifdef PPM_MODULE_ENTRY
#define PPM_MODULES(r) void PPM_MODULE_ENTRY(::ppm::Registry& r)
#elif defined(PPM_PLUGIN)
#include "framework/graph/abi.hpp"
#define PPM_MODULES(r)                                                             \
  extern "C" __attribute__((visibility("default"))) const char* ppm_plugin_abi() { \
    return PPM_ABI_STAMP;                                                          \
  }                                                                                \
  extern "C" __attribute__((visibility("default"))) void ppm_plugin_register(::ppm::Registry& r)
#endif
