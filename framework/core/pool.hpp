#pragma once
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace ppm {

/// Recycles objects, so that none is allocated in the hot path: the one that was given back last is handed out first,
/// with its memory and its old content. Thread-safe. Handles may outlive the pool.
template <class T>
class Pool {
 public:
  /// An object to be filled by its one writer; returns to the pool when its last handle goes.
  std::shared_ptr<T> take() {
    std::unique_ptr<T> object;
    {
      std::lock_guard lock(store_->mutex);
      if (!store_->free.empty()) {
        object = std::move(store_->free.back());
        store_->free.pop_back();
      }
    }
    if (!object) object = std::make_unique<T>();
    auto give_back = [store = store_](T* used) {
      std::unique_ptr<T> owned(used);
      std::lock_guard lock(store->mutex);
      store->free.push_back(std::move(owned));
    };
    return {object.release(), std::move(give_back)};
  }

 private:
  struct Store {
    std::mutex mutex;
    std::vector<std::unique_ptr<T>> free;
  };
  std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

}  // namespace ppm
