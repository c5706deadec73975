// A fixed set of threads that work on the strips of one image.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace arcstart::extraction {

class ThreadPool {
 public:
  // The caller's own thread is one of them: a pool of 1 starts none and never waits.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return static_cast<int>(threads_.size()) + 1; }

  // Calls work(strip) for 0 .. size()-1, each in a thread of its own, and returns when all have
  // ended. Throws what one of them threw. Not to be called from within work.
  template <class Work>
  void run(const Work& work) {
    run({&work, [](const void* called, int strip) { (*static_cast<const Work*>(called))(strip); }});
  }

 private:
  struct Task {
    const void* work = nullptr;
    void (*call)(const void* work, int strip) = nullptr;
  };
  void run(Task task);
  void serve(int strip);

  std::mutex mutex_;
  std::condition_variable begun_, ended_;
  Task task_;
  long round_ = 0;  // of tasks
  int busy_ = 0;    // threads that have not ended this round's
  bool closing_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

// The part of 0 .. count that belongs to a strip; count: may be 0.
struct StripRange {
  int begin, end;
  StripRange(int count, int strip, int strips)
      : begin(static_cast<int>(static_cast<long>(count) * strip / strips)),
        end(static_cast<int>(static_cast<long>(count) * (strip + 1) / strips)) {}
};

}  // namespace arcstart::extraction
