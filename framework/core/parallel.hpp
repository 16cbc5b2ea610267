#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace ppm {

/// A fixed number of worker threads (oneTBB arena). Work is split dynamically; results may depend on neither the split
/// nor the worker: use the worker number only to pick scratch memory.
class Workers {
 public:
  /// threads: 0 = as many as the machine has.
  explicit Workers(int threads = 0);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }
  /// Calls body(i, worker) once for each i in [0, n), worker in [0, threads()). An exception of a body reaches the caller.
  void for_each(std::size_t n, const std::function<void(std::size_t i, int worker)>& body) const;

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

/// One value for each worker, as scratch memory inside for_each.
template <class T>
class PerWorker {
 public:
  void resize(int threads) { values_.resize(static_cast<std::size_t>(threads)); }
  T& operator[](int worker) { return values_[static_cast<std::size_t>(worker)]; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }

 private:
  std::vector<T> values_;
};

}  // namespace ppm
