#pragma once
#include <cstddef>
#include <future>
#include <vector>

namespace morepro::host {

/// task(0) .. task(count - 1), each in its own thread, the first in this one; comes back when all are done.
/// Tasks may not share what they write, so the result does not depend on the number of cores. What a task
/// throws comes out here.
template <class Task>
void in_parallel(std::size_t count, const Task& task) {
  std::vector<std::future<void>> others;
  for (std::size_t i = 1; i < count; ++i)
    others.push_back(std::async(std::launch::async, [&task, i] { task(i); }));
  if (count > 0) task(0);
  for (std::future<void>& other : others) other.get();
}

}  // namespace morepro::host
