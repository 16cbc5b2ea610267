#pragma once
#include <string>
#include <vector>

#include "framework/config/params.hpp"
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
