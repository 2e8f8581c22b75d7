// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "map_keeper.hpp"

#include <exception>
#include <optional>

#include "map_ply.hpp"

namespace examples::slam {

using Lock = std::unique_lock<std::mutex>;

MapKeeper::MapKeeper(const Camera& camera, const MeasurementNoise& noise, bool has_thread)
    : mapping(camera, noise),
      multi_view(camera, noise),
      loop_closing(camera, noise),
      camera_(camera),
      has_thread_(has_thread) {
  if (has_thread_) thread_ = std::thread([this] { work(); });
}

MapKeeper::~MapKeeper() {
  if (!has_thread_) return;
  {
    const Lock lock(mutex);
    ends_ = true;
  }
  something_to_do_.notify_all();
  thread_.join();
}

void MapKeeper::add(KeyframeId id) {
  if (!has_thread_) return keep(id);
  {
    const Lock lock(mutex);
    rethrow_failure();
    queue_.push_back(id);
  }
  something_to_do_.notify_all();
}

void MapKeeper::finish() {
  if (!has_thread_) return;
  Lock lock(mutex);
  nothing_left_.wait(lock, [this] { return queue_.empty() && !is_busy_; });
  rethrow_failure();
}

void MapKeeper::rethrow_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

void MapKeeper::work() {
  Lock lock(mutex);
  while (true) {
    something_to_do_.wait(lock, [this] { return ends_ || !queue_.empty(); });
    if (ends_) return;
    const KeyframeId id = queue_.front();
    queue_.pop_front();
    is_busy_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      keep(id);
    } catch (...) {  // out of a thread it would end the program
      failure = std::current_exception();
    }
    lock.lock();
    is_busy_ = false;
    if (failure) {
      failure_ = failure;
      queue_.clear();
    }
    if (queue_.empty()) nothing_left_.notify_all();
  }
}

void MapKeeper::keep(KeyframeId id) {
  {
    const Lock lock(mutex);
    mapping.connect(id, map);
  }
  if (compares_views) adjust(id);
  thin(id);
  close_loop(id);
}

/// Long work on a copy: tracking goes on meanwhile.
void MapKeeper::adjust(KeyframeId id) {
  Lock lock(mutex);
  BundleProblem problem = multi_view.gather(id, map);
  lock.unlock();
  multi_view.converge(problem);
  lock.lock();
  multi_view.apply(problem, map);
}

void MapKeeper::thin(KeyframeId id) {
  const Lock lock(mutex);
  mapping.cull_points(id, map);
  for (const CulledKeyframe& culled : mapping.cull_keyframes(id, in_use, map)) {
    path.replace(culled);
    loop_closing.index.remove(culled.id);
  }
}

void MapKeeper::close_loop(KeyframeId id) {
  Lock lock(mutex);
  const std::optional<Recognised> recognised = loop_closing.recognise(id, map);
  loop_closing.index.add(map.keyframe(id));
  if (!recognised) return;
  before_loop = map_as_ply(map, camera_);
  loop_closing.close(*recognised, map);
  loops.push_back(recognised->loop);
  if (!compares_views) return;
  BundleProblem problem = multi_view.gather_all(map);
  lock.unlock();
  multi_view.converge(problem);
  lock.lock();
  multi_view.apply(problem, map);
}

}  // namespace examples::slam
