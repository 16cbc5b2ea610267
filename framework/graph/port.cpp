#include "framework/graph/port.hpp"

#include <typeinfo>

#include "framework/graph/module.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

PortBase::PortBase(Module* owner, PortDirection direction, std::string name, std::string doc, std::type_index type,
                   std::string_view type_name)
    : name_(std::move(name)), doc_(std::move(doc)), direction_(direction), type_(type), type_name_(type_name) {
  owner->ports_.push_back(this);
}

BeliefPortBase::BeliefPortBase(Module* owner, Facets facets, bool writes)
    : PortBase(owner, PortDirection::belief, "belief", writes ? "Read and changed." : "Read.", typeid(ParticleSet),
               PortType<ParticleSet>::name),
      facets_(std::move(facets)),
      writes_(writes) {}

}  // namespace ppm
