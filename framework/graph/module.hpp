#pragma once
#include <string>
#include <vector>

#include "framework/config/params.hpp"
#include "framework/core/record.hpp"
#include "framework/graph/context.hpp"
#include "framework/graph/port.hpp"

namespace ppm {

/// An algorithm that a graph can name. The constructor declares ports and parameters and does no work (it also runs for
/// `ppm list`); then open(), tick() once a frame, close(). Parameters are set and checked before open().
class Module {
 public:
  Module() = default;
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;
  virtual ~Module() = default;

  /// Before the first frame: open files, reserve memory. Throws DataError or ConfigError.
  virtual void open(Context&) {}
  virtual void tick(Context& context) = 0;
  /// After the last frame, also after Ctrl-C; not after an error.
  virtual void close(Context&) {}

  /// What the module keeps from frame to frame in its own members and needs to go on after this frame as if the run had
  /// not stopped; for checkpoints, between frames. Parameters, the belief and what can be made again (caches) are no part of it.
  virtual void save(RecordWriter&) const {}
  /// Takes back what save() wrote, all of it: after open(), before the first frame of a run that goes on. Throws
  /// DataError (in.fail) where it does not fit what open() found.
  virtual void load(RecordReader&) {}

  Params& params() { return params_; }
  const Params& params() const { return params_; }
  const std::vector<PortBase*>& ports() const { return ports_; }

 protected:
  Params params_;

 private:
  friend class PortBase;
  std::vector<PortBase*> ports_;
};

}  // namespace ppm
