#include "framework/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ppm {

struct Workers::Arena {
  explicit Arena(int threads)
      : allow(tbb::global_control::max_allowed_parallelism,
              static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()))),
        arena(threads) {}
  tbb::global_control allow;  // oneTBB starts no more threads than cores unless told to: N means N
  tbb::task_arena arena;
};

Workers::Workers(int threads)
    : threads_(threads > 0 ? threads : tbb::info::default_concurrency()), arena_(std::make_unique<Arena>(threads_)) {}

Workers::~Workers() = default;

void Workers::for_each(std::size_t n, const std::function<void(std::size_t, int)>& body) const {
  if (n == 0) return;
  using Range = tbb::blocked_range<std::size_t>;
  const std::size_t grain = std::max<std::size_t>(1, n / (static_cast<std::size_t>(threads_) * 32));
  // What oneTBB orders anyway (the caller before the bodies, the bodies before the return), said once more where
  // ThreadSanitizer sees it: the library's own code is not instrumented.
  std::atomic<int> order{0};
  order.store(1, std::memory_order_release);
  arena_->arena.execute([&] {
    // Isolated: a worker that waits for an inner loop must not start another item of the outer one, whose scratch it
    // holds.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          Range(0, n, grain),
          [&](const Range& range) {
            order.load(std::memory_order_acquire);
            const int worker = tbb::this_task_arena::current_thread_index();
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, worker);
            order.fetch_add(1, std::memory_order_release);
          },
          tbb::simple_partitioner{});
    });
  });
  order.load(std::memory_order_acquire);
}

}  // namespace ppm
