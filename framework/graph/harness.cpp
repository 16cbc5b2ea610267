#include "framework/graph/harness.hpp"

namespace ppm {

Harness::Harness(const Registry& registry, const std::string& module, const std::string& params_yaml, int threads,
                 std::uint64_t seed, std::filesystem::path out_dir)
    : workers_(threads), context_(workers_, log_, metrics_, seed, std::move(out_dir)) {
  const ModuleInfo* info = registry.find(module);
  PPM_CHECK(info, "no module '{}'", module);
  module_ = info->make();
  Diagnostics mistakes;
  Config params = parse_yaml(params_yaml, module);
  module_->params().parse(&params, module, params.place(), mistakes);
  if (!mistakes.empty()) throw ConfigError(mistakes);
  for (PortBase* port : module_->ports()) {
    if (port->direction() == PortDirection::belief) {
      static_cast<BeliefPortBase*>(port)->belief_ = &belief_;
    } else {
      port->slot_ = &slots_[{port->direction(), port->name()}];
    }
  }
  context_.enter(module);
}

void Harness::use(const std::string& port, Module& called) {
  for (PortBase* p : module_->ports()) {
    if (p->direction() != PortDirection::use || p->name() != port) continue;
    auto& input = static_cast<UsePortBase&>(*p);
    input.used_ = input.as_used(called);
    PPM_CHECK(input.used_, "'{}' cannot be called by input '{}'", input.type_name(), port);
    return;
  }
  throw InternalError(fmt::format("the module calls no other as '{}'", port));
}

bool Harness::tick() {
  if (!opened_) module_->open(context_);
  if (ticked_) ++context_.frame_;
  opened_ = ticked_ = true;
  module_->tick(context_);
  return !context_.ended_;
}

void Harness::close() {
  module_->close(context_);
}

std::string Harness::save() const {
  RecordWriter out;
  module_->save(out);
  return out.bytes();
}

void Harness::load(const std::string& state, std::int64_t frames) {
  module_->open(context_);
  opened_ = true;
  context_.frame_ = frames;
  RecordReader in(state, "the test's state", "the module");
  module_->load(in);
  in.finish();
}

std::shared_ptr<const void>* Harness::slot(PortDirection direction, const std::string& port, std::type_index type) {
  for (const PortBase* p : module_->ports()) {
    if (p->direction() == direction && p->name() == port && p->type() == type) return p->slot_;
  }
  throw InternalError(fmt::format("the module has no port '{}' of this direction and type", port));
}

}  // namespace ppm
