// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "map_ply.hpp"

#include <array>

#include "stillpoint/io/number_format.hpp"

namespace examples::slam {

namespace {

std::string vertex(const Vector3d& p_world, int red, int green, int blue) {
  std::string line;
  for (const double metres : {p_world.x(), p_world.y(), p_world.z()}) line += stillpoint::format_fixed(metres, 4) + ' ';
  return line + std::to_string(red) + ' ' + std::to_string(green) + ' ' + std::to_string(blue) + '\n';
}

}  // namespace

std::string map_as_ply(const Map& map, const stillpoint::Camera& camera) {
  constexpr double kPyramid_m = 0.08;
  std::string vertices, faces;
  std::size_t vertex_count = 0, face_count = 0;
  for (PointId id = 0; id < map.point_ids(); ++id) {
    if (!map.has_point(id) || map.point(id).observations.size() < 2) continue;
    const MapPoint& point = map.point(id);
    vertices += vertex(point.p_world, point.colour[2], point.colour[1], point.colour[0]);
    ++vertex_count;
  }
  const double right = camera.width(), bottom = camera.height();
  const std::array<Vector2d, 4> corners = {Vector2d(0, 0), Vector2d(right, 0), Vector2d(right, bottom),
                                           Vector2d(0, bottom)};
  for (const auto& entry : map.keyframes()) {
    const Pose world_from_camera = entry.second.camera_from_world.inverse();
    vertices += vertex(world_from_camera.translation(), 30, 90, 220);
    for (const Vector2d& corner : corners)
      vertices += vertex(world_from_camera * camera.back_project(corner, kPyramid_m), 30, 90, 220);
    for (std::size_t side = 0; side < corners.size(); ++side)
      faces += "3 " + std::to_string(vertex_count) + ' ' + std::to_string(vertex_count + 1 + side) + ' ' +
               std::to_string(vertex_count + 1 + (side + 1) % corners.size()) + '\n';
    vertex_count += 1 + corners.size();
    face_count += corners.size();
  }
  return "ply\nformat ascii 1.0\ncomment metres; the world is the camera of the first keyframe\nelement vertex " +
         std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty "
         "uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

}  // namespace examples::slam
