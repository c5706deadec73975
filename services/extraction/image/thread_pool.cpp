#include "services/extraction/image/thread_pool.hpp"

#include <utility>

namespace arcstart::extraction {

ThreadPool::ThreadPool(int threads) {
  for (int strip = 1; strip < threads; ++strip)
    threads_.emplace_back([this, strip] { serve(strip); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::run(Task task) {
  if (threads_.empty()) return task.call(task.work, 0);
  {
    const std::lock_guard lock(mutex_);
    task_ = task;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  begun_.notify_all();
  std::exception_ptr failure;
  try {
    task.call(task.work, 0);
  } catch (...) {
    failure = std::current_exception();
  }
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return busy_ == 0; });
  if (const std::exception_ptr other = std::exchange(failure_, nullptr); !failure) failure = other;
  if (failure) std::rethrow_exception(failure);
}

void ThreadPool::serve(int strip) {
  std::unique_lock lock(mutex_);
  for (long seen = 0;;) {
    begun_.wait(lock, [&] { return closing_ || round_ != seen; });
    if (closing_) return;
    seen = round_;
    const Task task = task_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      task.call(task.work, strip);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    if (--busy_ == 0) ended_.notify_one();
  }
}

}  // namespace arcstart::extraction
