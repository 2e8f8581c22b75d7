#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""make_networks.py FOLDER: writes small ONNX networks whose answers can be computed by hand. Debian: python3-onnx."""

import os
import sys

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

WIDTH, HEIGHT = 96, 64  # of the input; the cells of strides 8, 16, 32 are 96 + 24 + 6
CELLS = 126
folder = sys.argv[1]


def constant(name, values, dtype=np.float32):
    return numpy_helper.from_array(np.asarray(values, dtype), name)


def save(name, nodes, constants, outputs, image=(1, 3, HEIGHT, WIDTH), more_inputs=None, types=None):
    """outputs: {name: shape}; more_inputs: {name: (type, shape)}; types: of outputs that are not float"""
    graph = helper.make_graph(
        nodes, name,
        [helper.make_tensor_value_info('image', TensorProto.FLOAT, image)] +
        [helper.make_tensor_value_info(other, *what) for other, what in (more_inputs or {}).items()],
        [helper.make_tensor_value_info(output, (types or {}).get(output, TensorProto.FLOAT), shape)
         for output, shape in outputs.items()],
        constants)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid('', 11)], producer_name='stillpoint tests')
    model.ir_version = 6
    onnx.save(model, os.path.join(folder, name + '.onnx'))


def means_to(output, base, of_mean):
    """Nodes for `output` = base + sum over the input's channels k of mean_k * of_mean[k], whatever shape base has."""
    base = np.asarray(base, np.float32)
    weights = np.stack([np.asarray(of_mean.get(k, np.zeros_like(base)), np.float32).ravel() for k in range(3)], axis=1)
    return ([helper.make_node('GlobalAveragePool', ['image'], [output + '_means']),
             helper.make_node('Conv', [output + '_means', output + '_weights', output + '_base'], [output + '_flat'],
                              kernel_shape=[1, 1]),
             helper.make_node('Reshape', [output + '_flat', output + '_shape'], [output])],
            [constant(output + '_weights', weights.reshape(-1, 3, 1, 1)), constant(output + '_base', base.ravel()),
             constant(output + '_shape', base.shape, np.int64)])


def channel_means():
    """YOLOv8: box k, class k, has the mean of the input's channel k as its score, k = 0, 1, 2."""
    base = np.zeros((1, 84, CELLS))
    of_mean = {}
    for k in range(3):
        base[0, :4, k] = [16 + 32 * k, 32, 16, 32]  # middle and size
        of_mean[k] = np.zeros_like(base)
        of_mean[k][0, 4 + k, k] = 1
    nodes, constants = means_to('boxes', base, of_mean)
    save('channel_means', nodes, constants, {'boxes': base.shape})
    save('any_size', nodes, constants, {'boxes': base.shape}, image=(1, 3, 'height', 'width'))
    save('any_batch', nodes, constants, {'boxes': base.shape}, image=('batch', 3, HEIGHT, WIDTH))


def duplicates():
    """YOLOv8: three persons of which two are nearly the same, and a car where the first person is."""
    base = np.zeros((1, 84, CELLS))
    for column, (box, label, score) in enumerate([([20, 30, 20, 40], 0, 0.7), ([21, 30, 20, 40], 0, 0.9),
                                                  ([70, 30, 20, 40], 0, 0.6), ([20, 30, 20, 40], 2, 0.8)]):
        base[0, :4, column] = box
        base[0, 4 + label, column] = score
    save('duplicates', *means_to('boxes', base, {}), {'boxes': base.shape})


def first_channel():
    """Segmentation: the probability is the input's first channel, the other outputs are inner layers."""
    weights = np.zeros((1, 3, 1, 1))
    weights[0, 0] = 1
    save('first_channel',
         [helper.make_node('Conv', ['image', 'weights'], ['person'], kernel_shape=[1, 1]),
          helper.make_node('Neg', ['person'], ['not_person'])],
         [constant('weights', weights)], {'person': [1, 1, HEIGHT, WIDTH], 'not_person': [1, 1, HEIGHT, WIDTH]})


def label_map():
    """Segmentation with the choice inside: of 21 channels, person (15) is the input's first, background one half."""
    weights, bias = np.zeros((21, 3, 1, 1)), np.full(21, -1.0)
    weights[15, 0], bias[15], bias[0] = 1, 0, 0.5
    nodes = [helper.make_node('Conv', ['image', 'weights', 'bias'], ['scores'], kernel_shape=[1, 1]),
             helper.make_node('ArgMax', ['scores'], ['labels'], axis=1, keepdims=0)]
    constants = [constant('weights', weights), constant('bias', bias)]
    shape = {'labels': [1, HEIGHT, WIDTH]}
    save('label_map', nodes, constants, shape, types={'labels': TensorProto.INT64})
    nodes[1].output[0] = 'wide'
    for name, number in ('label_map_int32', TensorProto.INT32), ('label_map_float16', TensorProto.FLOAT16):
        save(name, nodes + [helper.make_node('Cast', ['wide'], ['labels'], to=number)], constants, shape,
             types={'labels': number})


def heads():
    """Two heads as YOLOv3, v4, v5 and v7 have them: one person in the middle of a cell, objectness by the red mean."""
    large, small = np.full((1, 255, 8, 12), -20.0), np.full((1, 255, 4, 6), -20.0)
    large[0, 85:89, 3, 5] = 0  # second anchor, row 3, column 5: t = 0
    large[0, 90, 3, 5] = 20
    red = np.zeros_like(large)
    red[0, 89, 3, 5] = 40  # objectness: sigmoid(40 red - 20)
    nodes, constants = means_to('stride8', large, {0: red})
    more_nodes, more_constants = means_to('stride16', small, {})
    save('heads', nodes + more_nodes, constants + more_constants, {'stride16': small.shape, 'stride8': large.shape})


def labelled_boxes():
    """As RT-DETR with its post-processing: corners are shares times the size that is the second input; the score of
    query k is the mean of channel k."""
    shares = np.array([[[0.25, 0.5, 0.5, 1], [0, 0, 0.5, 0.5], [0.5, 0.25, 1, 0.75]]])
    nodes, constants = means_to('scores', np.zeros((1, 3)), {k: np.eye(3)[k:k + 1] for k in range(3)})
    save('labelled_boxes',
         nodes + [helper.make_node('Cast', ['orig_target_sizes'], ['size'], to=TensorProto.FLOAT),
                  helper.make_node('Concat', ['size', 'size'], ['corner_sizes'], axis=1),
                  helper.make_node('Mul', ['shares', 'corner_sizes'], ['boxes']),
                  helper.make_node('Identity', ['classes'], ['labels'])],
         constants + [constant('shares', shares), constant('classes', [[0, 2, 56]], np.int64)],
         {'labels': [1, 3], 'boxes': [1, 3, 4], 'scores': [1, 3]},
         more_inputs={'orig_target_sizes': (TensorProto.INT64, ['batch', 2])}, types={'labels': TensorProto.INT64})
    save('second_image', [helper.make_node('Add', ['image', 'mask'], ['sum'])], [], {'sum': [1, 3, HEIGHT, WIDTH]},
         more_inputs={'mask': (TensorProto.FLOAT, [1, 'channels', HEIGHT, WIDTH])})


def as_many_as_found():
    """As networks with suppression inside: row k is there if the mean of channel k is above one half."""
    rows = np.array([[8, 16, 24, 48, 0.9, 0], [40, 16, 56, 48, 0.8, 1], [72, 16, 88, 48, 0.7, 2]])
    nodes, constants = means_to('means', np.zeros(3), {k: np.eye(3)[k] for k in range(3)})
    save('as_many_as_found',
         nodes + [helper.make_node('Greater', ['means', 'half'], ['there']),
                  helper.make_node('Compress', ['rows', 'there'], ['found'], axis=1)],
         constants + [constant('half', [0.5]), constant('rows', rows[np.newaxis])], {'found': [1, 'count', 6]})


def what_fails():
    nodes, constants = means_to('boxes', np.zeros((1, 4, CELLS)), {})
    save('cannot_run', nodes + [helper.make_node('Mul', ['boxes', 'strides'], ['scaled'])],
         constants + [constant('strides', np.ones((1, CELLS)))], {'scaled': [1, 4, CELLS]})
    save('cannot_read', [helper.make_node('TopK', ['image', 'k'], ['best', 'where'])],
         [constant('k', [3], np.int64)], {'best': [1, 3, HEIGHT, 3]})
    save('no_layout', *means_to('scores', np.zeros((1, 1000)), {}), {'scores': [1, 1000]})


channel_means()
duplicates()
first_channel()
label_map()
heads()
labelled_boxes()
as_many_as_found()
what_fails()
