#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "framework/core/error.hpp"
#include "framework/core/record.hpp"

namespace ppm {

class Module;
class ParticleSet;
struct Frame;

/// Name of a port's type for messages and pages. Specialise for each type that travels on an edge. Such a type is one that a
/// RecordWriter takes, so that checkpoints can keep it.
template <class T>
struct PortType;
template <>
struct PortType<Frame> {
  static constexpr std::string_view name = "frame";
};
template <>
struct PortType<ParticleSet> {
  static constexpr std::string_view name = "belief";
};

/// What the belief must carry before a node and carries after it. Facets are words: "map.ppm", "prediction", "weights".
/// "map.*" asks for a map of any kind. A node that gives "map.x" drops every other map facet. A facet "x.y" is a part of
/// "x": it goes when "x" is dropped or given anew.
struct Facets {
  std::vector<std::string> needs;
  std::vector<std::string> gives;
  std::vector<std::string> drops;
};

/// A port of direction `belief` is a BeliefPortBase, one of direction `use` a UsePortBase.
enum class PortDirection { in, out, belief, use };

/// The part of a port that the graph sees. Registers itself with its module.
class PortBase {
 public:
  PortBase(Module* owner, PortDirection direction, std::string name, std::string doc, std::type_index type,
           std::string_view type_name);
  PortBase(const PortBase&) = delete;
  PortBase& operator=(const PortBase&) = delete;

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  PortDirection direction() const { return direction_; }
  std::type_index type() const { return type_; }
  std::string_view type_name() const { return type_name_; }
  /// Out ports: the In port whose value passes through when the node is gated off, or null.
  const PortBase* identity() const { return identity_; }

 protected:
  friend class GraphBuilder;
  friend class Executor;
  friend class Harness;
  std::string name_, doc_;
  PortDirection direction_;
  std::type_index type_;
  std::string_view type_name_;
  const PortBase* identity_ = nullptr;
  std::shared_ptr<const void>* slot_ = nullptr;  // of the edge; set when the graph is built
  // Out ports: the value as it is kept in a checkpoint.
  void (*save_value_)(RecordWriter&, const void*) = nullptr;
  std::shared_ptr<const void> (*load_value_)(RecordReader&) = nullptr;
};

/// An input: the value that an output above made in this frame. Immutable, shared.
template <class T>
class In : public PortBase {
 public:
  In(Module* owner, std::string name, std::string doc)
      : PortBase(owner, PortDirection::in, std::move(name), std::move(doc), typeid(T), PortType<T>::name) {}
  /// For keeping the value beyond this frame.
  std::shared_ptr<const T> get() const { return std::static_pointer_cast<const T>(value()); }
  const T& operator*() const { return *static_cast<const T*>(value().get()); }
  const T* operator->() const { return &**this; }

 private:
  const std::shared_ptr<const void>& value() const {
    PPM_CHECK(slot_ && *slot_, "input '{}' has no value", name_);
    return *slot_;
  }
};

/// An output. A node that can be gated off names the input that stands in for it then; sources cannot be gated.
template <class T>
class Out : public PortBase {
 public:
  Out(Module* owner, std::string name, std::string doc, const In<T>* identity = nullptr)
      : PortBase(owner, PortDirection::out, std::move(name), std::move(doc), typeid(T), PortType<T>::name) {
    identity_ = identity;
    save_value_ = [](RecordWriter& out, const void* value) { out.add(*static_cast<const T*>(value)); };
    load_value_ = [](RecordReader& in) -> std::shared_ptr<const void> { return std::make_shared<const T>(in.take<T>()); };
  }
  void set(std::shared_ptr<const T> value) {
    PPM_CHECK(slot_, "output '{}' is not wired to a graph", name_);
    *slot_ = std::move(value);
  }
};

/// The part of a Use that the graph sees.
class UsePortBase : public PortBase {
 public:
  /// The module as what this port calls, or null where it is something else.
  void* as_used(Module& module) const { return as_used_(module); }

 protected:
  friend class GraphBuilder;
  friend class Harness;
  UsePortBase(Module* owner, std::string name, std::string doc, std::type_index type, std::string_view type_name,
              void* (*cast)(Module&))
      : PortBase(owner, PortDirection::use, std::move(name), std::move(doc), type, type_name), as_used_(cast) {}
  void* (*as_used_)(Module&);
  void* used_ = nullptr;
};

/// Another node of the graph, above or below, that this one calls as a T (a role): `in: {view: look}` names the node,
/// not an output. What is called must be as good as a function of its arguments: the node's own ticks are not seen.
template <class T>
class Use : public UsePortBase {
 public:
  Use(Module* owner, std::string name, std::string doc)
      : UsePortBase(owner, std::move(name), std::move(doc), typeid(T), PortType<T>::name,
                    [](Module& module) -> void* { return dynamic_cast<T*>(&module); }) {}
  T& operator*() const {
    PPM_CHECK(used_, "input '{}' names no node", name_);
    return *static_cast<T*>(used_);
  }
  T* operator->() const { return &**this; }
};

/// Access to the belief, which the executor owns. It needs no `in:` line.
class BeliefPortBase : public PortBase {
 public:
  BeliefPortBase(Module* owner, Facets facets, bool writes);
  const Facets& facets() const { return facets_; }
  bool writes() const { return writes_; }

 protected:
  friend class GraphBuilder;
  friend class Executor;
  friend class Harness;
  Facets facets_;
  bool writes_;
  ParticleSet* belief_ = nullptr;
};

template <class T>
class InOut;
/// The belief, to be changed.
template <>
class InOut<ParticleSet> : public BeliefPortBase {
 public:
  InOut(Module* owner, Facets facets) : BeliefPortBase(owner, std::move(facets), true) {}
  ParticleSet& operator*() const { return *belief_; }
  ParticleSet* operator->() const { return belief_; }
};
/// The belief, to be read (sinks).
template <>
class In<ParticleSet> : public BeliefPortBase {
 public:
  In(Module* owner, Facets facets) : BeliefPortBase(owner, std::move(facets), false) {}
  const ParticleSet& operator*() const { return *belief_; }
  const ParticleSet* operator->() const { return belief_; }
};

}  // namespace ppm
