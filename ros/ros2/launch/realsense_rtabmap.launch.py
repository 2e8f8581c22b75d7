# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT
"""A RealSense D400, the filter, and RTAB-Map on depth without moving objects."""

from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode

COLOUR = '/camera/camera/color/image_raw'
CAMERA_INFO = '/camera/camera/color/camera_info'
DEPTH = '/camera/camera/aligned_depth_to_color/image_raw'
DEPTH_WITHOUT_MOVERS = '/stillpoint/depth'


def generate_launch_description():
    camera = ComposableNode(
        package='realsense2_camera', plugin='realsense2_camera::RealSenseNodeFactory',
        namespace='camera', name='camera',
        parameters=[{'align_depth.enable': True, 'enable_sync': True}])
    stillpoint = ComposableNode(
        package='stillpoint_ros', plugin='stillpoint_ros2::StillpointComponent', name='stillpoint',
        # Baseline and focal length of a D435's infrared cameras at 640 x 480: put in yours (docs/your_camera.md).
        parameters=[{'depth_noise.model': 'stereo',
                     'depth_noise.baseline_m': 0.050,
                     'depth_noise.focal_px': 385.0}],
        remappings=[('image', COLOUR), ('depth', DEPTH), ('camera_info', CAMERA_INFO)])
    container = ComposableNodeContainer(
        name='stillpoint_container', namespace='', package='rclcpp_components',
        executable='component_container_mt', output='screen',
        composable_node_descriptions=[camera, stillpoint])

    slam = {
        'parameters': [{'frame_id': 'camera_link', 'subscribe_depth': True, 'approx_sync': True,
                        'approx_sync_max_interval': 0.01}],
        'remappings': [('rgb/image', COLOUR), ('rgb/camera_info', CAMERA_INFO),
                       ('depth/image', DEPTH_WITHOUT_MOVERS)],
    }
    return LaunchDescription([
        container,
        Node(package='rtabmap_odom', executable='rgbd_odometry', output='screen', **slam),
        Node(package='rtabmap_slam', executable='rtabmap', output='screen', arguments=['-d'], **slam),
    ])
