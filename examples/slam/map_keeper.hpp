// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What happens to the map behind tracking, in a thread of its own or in step with it: each new keyframe is connected,
// its window adjusted, the map thinned, and loops closed.

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "loop_closing.hpp"
#include "map.hpp"
#include "mapping.hpp"
#include "multi_view.hpp"
#include "path.hpp"

namespace examples::slam {

class MapKeeper {
 public:
  /// @param has_thread  false: `add` returns when all is done, the same bytes each time
  MapKeeper(const Camera& camera, const MeasurementNoise& noise, bool has_thread);
  /// Ends after the keyframe that is being worked on.
  ~MapKeeper();
  MapKeeper(const MapKeeper&) = delete;
  MapKeeper& operator=(const MapKeeper&) = delete;

  // Set before the first frame.
  Mapping mapping;
  MultiView multi_view;
  LoopClosing loop_closing;
  bool compares_views = true;  ///< false: no multi-view geometry, no adjustment

  std::mutex mutex;  ///< of what follows, and of loop_closing.index
  Map map;
  Path path;
  KeyframeId in_use = kNone;  ///< tracking stands on it: it is not removed
  std::vector<Loop> loops;
  std::string before_loop;  ///< the map as PLY, before the last of them

  /// A keyframe has joined the map. Call it without the lock.
  /// @throws what an earlier keyframe threw in the thread; the map is not kept any more then
  void add(KeyframeId id);
  /// How many wait. Call it with the lock.
  std::size_t waiting() const { return queue_.size(); }
  /// Returns when no keyframe waits any more. Call it without the lock.
  /// @throws the same
  void finish();

 private:
  void work();
  void rethrow_failure() const;
  void keep(KeyframeId id);
  void adjust(KeyframeId id);
  void thin(KeyframeId id);
  void close_loop(KeyframeId id);

  Camera camera_;
  bool has_thread_;
  std::deque<KeyframeId> queue_;
  bool is_busy_ = false, ends_ = false;
  std::exception_ptr failure_;
  std::condition_variable something_to_do_, nothing_left_;
  std::thread thread_;
};

}  // namespace examples::slam
