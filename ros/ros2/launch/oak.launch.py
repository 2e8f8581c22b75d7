# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT
"""An OAK-D with depth aligned to colour, image_proc, and the filter.

Its masks are of /oak/rgb/image_rect, on /stillpoint/mask and /stillpoint/mask_inverse.
"""

from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    camera = ComposableNode(
        package='depthai_ros_driver', plugin='depthai_ros_driver::Camera', name='oak',
        parameters=[{'camera.i_pipeline_type': 'RGBD',
                     'camera.i_nn_type': 'none',
                     'stereo.i_subpixel': True}])
    # The driver's colour images are raw, with a lens of eight coefficients (rational_polynomial), which the filter has
    # no model of. The package image_proc must be installed.
    rectify = ComposableNode(
        package='image_proc', plugin='image_proc::RectifyNode', name='rectify_rgb',
        remappings=[('image', '/oak/rgb/image_raw'),
                    ('camera_info', '/oak/rgb/camera_info'),
                    ('image_rect', '/oak/rgb/image_rect')])
    stillpoint = ComposableNode(
        package='stillpoint_ros', plugin='stillpoint_ros2::StillpointComponent', name='stillpoint',
        # Baseline and focal length of an OAK-D's mono cameras at 640 x 400: put in yours (docs/your_camera.md).
        parameters=[{'rectified': True,
                     'depth_noise.model': 'stereo',
                     'depth_noise.baseline_m': 0.075,
                     'depth_noise.focal_px': 400.0}],
        remappings=[('image', '/oak/rgb/image_rect'),
                    ('depth', '/oak/stereo/image_raw'),
                    ('camera_info', '/oak/rgb/camera_info')])
    return LaunchDescription([
        ComposableNodeContainer(
            name='stillpoint_container', namespace='', package='rclcpp_components',
            executable='component_container_mt', output='screen',
            composable_node_descriptions=[camera, rectify, stillpoint])])
