// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A pose graph: poses and what is known of pairs of them. A closed loop is spread over all of it, before points are
// looked at again. This header is free of Ceres.

#include <vector>

#include "frame.hpp"

namespace examples::slam {

struct PoseGraph {
  struct Node {
    KeyframeId keyframe = kNone;
    Pose camera_from_world = Pose::Identity();
    bool is_fixed = false;
  };
  struct Edge {
    int a = 0, b = 0;  ///< indices of nodes
    Pose a_from_b = Pose::Identity();
    double weight = 1.0;  ///< times the squared error
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;
};

/// Least squares on all edges. A radian counts as much as two metres: what a camera sees is that far away.
void relax(PoseGraph& graph, int iterations = 30);

}  // namespace examples::slam
