#pragma once
#include <atomic>
#include <cstdint>
#include <utility>

namespace ppm {

/// A value shared by copies of its handle and cloned when written through a handle that is not the only one.
/// One pointer wide; copying is one atomic increment. Reading is safe from any thread; write() needs the handle for itself
/// (other handles to the same value may be read, copied and dropped meanwhile by other threads).
/// T must be copyable. A default-constructed handle is empty.
template <class T>
class Cow {
 public:
  Cow() = default;
  template <class... Args>
  static Cow make(Args&&... args) {
    Cow cow;
    cow.block_ = new Block{{1}, T(std::forward<Args>(args)...)};
    return cow;
  }
  Cow(const Cow& other) noexcept : block_(other.block_) {
    if (block_) block_->count.fetch_add(1, std::memory_order_relaxed);
  }
  Cow(Cow&& other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  Cow& operator=(Cow other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  ~Cow() { release(); }

  explicit operator bool() const { return block_ != nullptr; }
  const T& operator*() const { return block_->value; }
  const T* operator->() const { return &block_->value; }
  const T* get() const { return block_ ? &block_->value : nullptr; }
  /// True when no other handle refers to the value.
  bool unique() const { return block_ && block_->count.load(std::memory_order_acquire) == 1; }
  /// The number of handles that share the value, for statistics.
  std::int64_t use_count() const { return block_ ? block_->count.load(std::memory_order_acquire) : 0; }
  bool operator==(const Cow& other) const { return block_ == other.block_; }

  /// The value for writing: cloned first unless this handle is the only one.
  T& write() {
    if (!unique()) *this = make(block_->value);
    return block_->value;
  }

 private:
  struct Block {
    std::atomic<std::int64_t> count;
    T value;
  };
  void release() {
    if (block_ && block_->count.fetch_sub(1, std::memory_order_acq_rel) == 1) delete block_;
    block_ = nullptr;
  }
  Block* block_ = nullptr;
};

}  // namespace ppm
