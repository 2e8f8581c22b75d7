# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""What goes in: shapes, types, strides, lifetimes. What is wrong is an exception that names it."""

import gc
import sys
import threading

import cv2
import numpy as np
import pytest

import stillpoint
from stillpoint import Status


def run(frames, camera, change=lambda frame: {}, **more):
    """Each frame through a new filter, with arguments changed; the results."""
    frame_filter = stillpoint.FrameFilter(camera)
    results = []
    for frame in frames:
        arguments = dict(image=frame.gray, depth=frame.depth, timestamp_s=frame.timestamp_s, keypoints=frame.pixels,
                         depth_factor=5000)
        arguments.update(more)
        arguments.update(change(frame))
        results.append(frame_filter.filter_frame(**arguments))
    return results


def same(results, others):
    return all(a.status == b.status and np.array_equal(a.keep, b.keep) and np.array_equal(a.scores, b.scores, equal_nan=True)
               for a, b in zip(results, others))


@pytest.fixture(scope="module")
def expected(frames, camera):
    return run(frames[:4], camera)


def wide(array):
    """The same values, in rows with gaps between them, as a part of a larger image has."""
    larger = np.zeros((array.shape[0] + 6, array.shape[1] + 10, *array.shape[2:]), array.dtype)
    part = larger[2:-4, 4:-6]
    part[...] = array
    assert not part.flags.c_contiguous
    return part


def test_rows_with_gaps(frames, camera, expected):
    assert same(expected, run(frames[:4], camera, lambda f: dict(image=wide(f.gray), depth=wide(f.depth))))


def test_read_only_arrays(frames, camera, expected):
    def locked(array):
        array = array.copy()
        array.flags.writeable = False
        return array
    assert same(expected, run(frames[:4], camera, lambda f: dict(image=locked(f.gray), depth=locked(f.depth),
                                                                 keypoints=locked(f.pixels))))


def test_arrays_are_not_kept(frames, camera, expected):
    """Deleted, or overwritten, behind the call: the filter has what it needs."""
    held = []

    def passing(frame):
        for array in held:
            array[...] = 7
        held[:] = [frame.gray.copy(), frame.depth.copy()]
        return dict(image=held[0], depth=held[1])
    assert same(expected, run(frames[:4], camera, passing))

    def deleted(frame):
        gc.collect()
        return dict(image=frame.gray.copy(), depth=frame.depth.copy())
    assert same(expected, run(frames[:4], camera, deleted))
    image = frames[0].gray.copy()
    before = sys.getrefcount(image)
    run(frames[:1], camera, image=image)
    assert sys.getrefcount(image) == before


def test_results_own_their_arrays(frames, camera):
    frame_filter = stillpoint.FrameFilter(camera)
    keeps = []
    copies = []
    for frame in frames[:4]:
        result = frame_filter.filter_frame(frame.gray, frame.depth, frame.timestamp_s, frame.pixels, 5000)
        keeps.append(result.keep)
        copies.append(result.keep.copy())
    mask = result.mask()
    del frame_filter, result
    gc.collect()
    assert all(np.array_equal(keep, copy) for keep, copy in zip(keeps, copies))
    assert mask.shape == frames[0].gray.shape and set(np.unique(mask)) <= {0, 255}


def test_movers_keep_their_result(frames, camera):
    frame_filter = stillpoint.FrameFilter(camera, movers=True)
    frame_filter.options.movers.least_path_m = 0.003  # of these few frames
    frame_filter.options.movers.least_path_sigmas = 1
    for frame in frames[:11]:
        result = frame_filter.filter_frame(frame.gray, frame.depth, frame.timestamp_s, frame.pixels, 5000)
    mover = result.movers[0]
    mask, text = mover.mask(), repr(mover)
    del frame_filter, result
    gc.collect()
    assert np.array_equal(mover.mask(), mask) and (mask == 0).any() and repr(mover) == text
    assert text.startswith("<Mover 1: moving, at (") and text.endswith(" m/s>")
    assert mover.state is stillpoint.MoverState.moving
    with pytest.raises(AttributeError):
        mover.id = 2


def test_bgr_and_keypoints_of_any_form(frames, camera, expected):
    bgr = run(frames[:4], camera, lambda f: dict(image=cv2.cvtColor(f.gray, cv2.COLOR_GRAY2BGR)))
    assert same(expected, bgr)
    for form in (lambda pixels: pixels[:, None, :], lambda pixels: pixels.astype(np.float64), np.asfortranarray,
                 lambda pixels: cv2.KeyPoint_convert(pixels), lambda pixels: tuple(cv2.KeyPoint_convert(pixels))):
        assert same(expected, run(frames[:4], camera, lambda f: dict(keypoints=form(f.pixels))))


@pytest.mark.parametrize("nothing", [[], (), np.empty((0, 2), np.float32), np.array([])], ids=lambda n: type(n).__name__)
def test_no_keypoints(frames, camera, nothing):
    results = run(frames[:2], camera, keypoints=nothing)
    assert results[1].status == Status.no_keypoints and len(results[1]) == 0 and results[1].keep.shape == (0,)


def test_no_depth_keeps_all(frames, camera):
    results = run(frames[:3], camera, depth=None, depth_factor=None)
    assert results[2].status == Status.no_depth and results[2].keep.all()


def test_a_camera_at_rest_is_stationary_and_its_old_name_warns(frames, camera):
    motion = run(frames[:2], camera)[1].motion
    with pytest.warns(DeprecationWarning, match="Motion.stationary"):
        assert motion.standing == motion.stationary
    assert isinstance(motion.stationary, bool)


def test_bad_frames_have_a_status(frames, camera):
    frame_filter = stillpoint.FrameFilter(camera)
    first = frames[0]

    def status(**more):
        arguments = dict(image=first.gray, depth=first.depth, timestamp_s=1.0, keypoints=first.pixels, depth_factor=5000)
        arguments.update(more)
        result = frame_filter.filter_frame(**arguments)
        assert result.keep.all() and len(result) == len(arguments["keypoints"])
        return result.status
    assert status(image=np.zeros((0, 0), np.uint8)) == Status.no_image
    assert status(image=np.zeros((5, 7), np.uint8)) == Status.size_changed
    assert status(timestamp_s=float("nan")) == Status.invalid_time
    assert status(depth=np.full(first.depth.shape, 1500, np.float32), depth_factor=None) == Status.implausible_depth
    assert status() == Status.first_frame
    assert status() == Status.duplicate_frame
    assert status(timestamp_s=5) == Status.time_gap
    assert status(timestamp_s=4) == Status.out_of_order
    assert "nanoseconds" in frame_filter.filter_frame(first.gray, None, 1e18, first.pixels).hint


GRAY, DEPTH, PIXELS = np.zeros((240, 320), np.uint8), np.ones((240, 320), np.uint16), np.ones((5, 2), np.float32)


@pytest.mark.parametrize("wrong, error, words", [
    (dict(image=None), TypeError, "image is NoneType, expected a NumPy array of uint8"),
    (dict(image=GRAY.tolist()), TypeError, "image is list"),
    (dict(image=GRAY.astype(np.float32)), TypeError, "image has dtype float32, expected a NumPy array of uint8"),
    (dict(image=GRAY.astype(np.int8)), TypeError, "image has dtype int8"),
    (dict(image=GRAY.ravel()), stillpoint.Error, r"image has shape \(76800,\), expected \(height, width\)"),
    (dict(image=np.zeros((240, 320, 4), np.uint8)), stillpoint.Error, r"image has shape \(240, 320, 4\)"),
    (dict(image=np.zeros((240, 640), np.uint8)[:, ::2]), stillpoint.Error, r"image has strides \(640, 2\).*ascontiguousarray"),
    (dict(image=GRAY[::-1]), stillpoint.Error, "image has strides .*ascontiguousarray"),
    (dict(image=GRAY[:, ::-1]), stillpoint.Error, "image has strides"),
    (dict(image=np.zeros((320, 240), np.uint8).T), stillpoint.Error, "image has strides"),
    (dict(image=np.broadcast_to(np.zeros(320, np.uint8), (240, 320))), stillpoint.Error, "image has strides"),
    (dict(image=np.zeros((240, 320, 3), np.uint8)[..., ::-1]), stillpoint.Error, "image has strides"),
    (dict(depth=DEPTH.astype(np.float64)), TypeError, "depth has dtype float64, expected a NumPy array of uint16"),
    (dict(depth=DEPTH.astype(np.int16)), TypeError, "depth has dtype int16"),
    (dict(depth=DEPTH.astype(">u2")), TypeError, "depth has dtype >u2"),
    (dict(depth=DEPTH[None]), stillpoint.Error, r"depth has shape \(1, 240, 320\), expected \(height, width\)"),
    (dict(depth=np.ones((240, 640), np.uint16)[:, ::2]), stillpoint.Error, "depth has strides"),
    (dict(depth=np.zeros(2 * 240 * 320 + 1, np.uint8)[1:].view(np.uint16).reshape(240, 320)), stillpoint.Error,
     "depth has strides|depth is not aligned"),
    (dict(depth_factor=None), stillpoint.Error, "depth_factor is missing, expected .* 1000 for millimetres"),
    (dict(depth_factor=0), stillpoint.Error, "depth_factor is 0, expected"),
    (dict(depth_factor=1e-300), stillpoint.Error, "depth_factor is 1e-300, expected"),
    (dict(depth_factor=float("nan")), stillpoint.Error, "depth_factor is nan, expected"),
    (dict(depth=DEPTH.astype(np.float32)), stillpoint.Error, "depth_factor is 1000 for a depth of float32, expected none"),
    (dict(keypoints=None), TypeError, "keypoints are NoneType, expected a NumPy array"),
    (dict(keypoints="points"), TypeError, "keypoints are str"),
    (dict(keypoints=[(1.0, 2.0)]), TypeError, r"keypoints\[0\] is tuple, expected a cv2.KeyPoint"),
    (dict(keypoints=[type("Wrong", (), {"pt": 3.0})()]), TypeError, r"keypoints\[0\] is Wrong, expected a cv2.KeyPoint"),
    (dict(keypoints=PIXELS.astype(int)), TypeError, "keypoints have dtype int64, expected float32 or float64"),
    (dict(keypoints=PIXELS.T), stillpoint.Error, r"keypoints have shape \(2, 5\), expected \(N, 2\)"),
    (dict(keypoints=PIXELS.ravel()), stillpoint.Error, r"keypoints have shape \(10,\)"),
    (dict(timestamp_s="now"), TypeError, "timestamp_s"),
])
def test_wrong_arguments(wrong, error, words):
    frame_filter = stillpoint.FrameFilter(stillpoint.Camera(260, 260, 160, 120, 320, 240))
    arguments = dict(image=GRAY, depth=DEPTH, timestamp_s=0.0, keypoints=PIXELS, depth_factor=1000)
    arguments.update(wrong)
    with pytest.raises(error, match=words):
        frame_filter.filter_frame(**arguments)
    result = frame_filter.filter_frame(GRAY, DEPTH, 0.0, PIXELS, 1000)
    assert result.status == Status.first_frame  # nothing of the wrong frame was taken


@pytest.mark.parametrize("method", ["feedback", "expect_motion"])
def test_poses(frame_filter, method):
    call = getattr(frame_filter, method)
    call(np.eye(4))
    call(np.eye(4, dtype=np.float32))
    call(np.asfortranarray(np.eye(4)))
    drifted = np.eye(4, dtype=np.float32)
    drifted[0, 0] = 1.001  # what many products in single precision leave
    call(drifted)
    for wrong, determinant in ((np.diag([1.0, 1.0, -1.0, 1.0]), "-1"), (np.diag([2.0, 2.0, 2.0, 1.0]), "8")):
        with pytest.raises(stillpoint.Error, match=f"^[a-z_]+ holds no rotation: the determinant of its 3 x 3 part is "
                                                   f"{determinant}, expected orthogonal columns of length 1"):
            call(wrong)
    for number in (np.nan, np.inf):
        with pytest.raises(stillpoint.Error, match="^[a-z_]+ holds (nan|inf) in row 0, column 3, expected finite numbers$"):
            call(np.array([[1, 0, 0, number], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
    with pytest.raises(stillpoint.Error, match="holds nan in row 0, column 0"):
        call(np.full((4, 4), np.nan))
    with pytest.raises(stillpoint.Error, match=r"has shape \(3, 4\), expected \(4, 4\)"):
        call(np.eye(4)[:3])
    transposed = np.eye(4)
    transposed[3, 0] = 0.1
    with pytest.raises(stillpoint.Error, match="another last row than 0 0 0 1: is it transposed"):
        call(transposed)
    with pytest.raises(TypeError, match="is list, expected a NumPy array"):
        call(np.eye(4).tolist())


def test_cameras():
    with pytest.raises(stillpoint.Error, match="camera: fx is -1, expected a positive focal length in pixels"):
        stillpoint.Camera(-1, 525, 320, 240, 640, 480)
    with pytest.raises(stillpoint.Error, match="model is 'fisheye', expected pinhole, brown_conrady or equidistant"):
        stillpoint.Camera(525, 525, 320, 240, 640, 480, model="fisheye")
    with pytest.raises(stillpoint.Error, match="2 coefficients with model brown_conrady, expected k1 k2 p1 p2"):
        stillpoint.Camera(525, 525, 320, 240, 640, 480, "brown_conrady", [0.1, 0.2])
    with pytest.raises(stillpoint.Error, match="1 coefficients with model pinhole, expected none"):
        stillpoint.Camera(525, 525, 320, 240, 640, 480, distortion=[0.1])
    with pytest.raises(stillpoint.Error, match="distortion is not finite"):
        stillpoint.Camera(525, 525, 320, 240, 640, 480, "equidistant", [0.1, float("nan"), 0, 0])
    lens = stillpoint.Camera(525, 526, 320, 240, 640, 480, "brown_conrady", [0.1, 0.2, 0, 0])
    assert (lens.fx, lens.fy, lens.cx, lens.cy, lens.width, lens.height) == (525, 526, 320, 240, 640, 480)
    as_opencv = np.array([[0.1, 0.2, 0, 0, 0]])  # the shape that cv2.calibrateCamera gives
    assert repr(stillpoint.Camera(525, 526, 320, 240, 640, 480, "brown_conrady", as_opencv)) == repr(lens)
    assert repr(lens) == "Camera(fx=525, fy=526, cx=320, cy=240, width=640, height=480, model='brown_conrady')"
    with pytest.raises(stillpoint.Error, match="none.yaml"):
        stillpoint.read_camera("none.yaml")
    assert issubclass(stillpoint.Error, ValueError)


def test_a_lens_is_used(frames, camera):
    """A lens bends the pixels' rays: another motion comes out."""
    bent = stillpoint.Camera(camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height, "brown_conrady",
                             [0.2, 0, 0, 0])
    straight, other = run(frames[:3], camera)[2].motion, run(frames[:3], bent)[2].motion
    assert not np.array_equal(straight.current_from_reference, other.current_from_reference)


def test_detections(frames, camera):
    with pytest.raises(stillpoint.Error, match="mobility is 9, expected a stillpoint.Mobility"):
        stillpoint.Detection(0, 0, 1, 1, 9)
    with pytest.raises(TypeError, match="mask has dtype float64"):
        stillpoint.Detection(0, 0, 1, 1, mask=np.ones((2, 2)))
    for shape, text in (((4,), r"\(4,\)"), ((0, 5), r"\(0, 5\)")):
        with pytest.raises(stillpoint.Error, match=f"mask has shape {text}, expected .rows, columns. with 1 to 67108864 cells"):
            stillpoint.Detection(0, 0, 1, 1, mask=np.ones(shape, bool))
    for name, value, expected in [("x", np.nan, "a finite number of pixels"), ("y", np.inf, "a finite number of pixels"),
                                  ("width", np.nan, "0 or more pixels"), ("height", -1, "0 or more pixels"),
                                  ("width", np.inf, "0 or more pixels"), ("confidence", np.nan, "a number from 0 to 1"),
                                  ("confidence", 1.5, "a number from 0 to 1"), ("confidence", -0.5, "a number from 0 to 1")]:
        with pytest.raises(stillpoint.Error, match=f"^{name} is {value}, expected {expected}$"):
            stillpoint.Detection(**{**dict(x=0, y=0, width=1, height=1), name: value})
    stillpoint.Detection(-5, -5, 0, 0, confidence=0)  # clipped at an image's rim: it covers nothing
    everywhere = dict(x=0, y=0, width=320, height=240, mobility=stillpoint.Mobility.dynamic)

    def kept(**more):
        frame_filter = stillpoint.FrameFilter(camera)
        frame_filter.options.classifier.dynamic_shift = 2.4  # nats: in one frame the default's 2 drop nothing
        for frame in frames[:2]:
            if more:
                frame_filter.detected(frame.timestamp_s, [stillpoint.Detection(**everywhere, **more)])
            result = frame_filter.filter_frame(frame.gray, frame.depth, frame.timestamp_s, frame.pixels, 5000)
        return result.keep
    nothing = np.zeros((240, 320), bool)
    assert np.array_equal(kept(), kept(mask=nothing))  # a mask without an object is no object
    assert not np.array_equal(kept(), kept(mask=~nothing))


def test_threads_share_nothing(frames, camera, expected):
    """Filters in threads of their own say what one alone says; two threads on one filter do not harm it."""
    answers = {}

    def work(name):
        answers[name] = run(frames[:4], camera)
    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4 and all(same(expected, answer) for answer in answers.values())

    shared = stillpoint.FrameFilter(camera)
    statuses = []

    def hammer():
        for frame in frames * 2:
            statuses.append(shared.filter_frame(frame.gray, frame.depth, frame.timestamp_s, frame.pixels, 5000).status)
            shared.options.gate.false_positive_rate = 0.01
            shared.predicted_keep_mask(frame.timestamp_s)
            shared.reset()
    threads = [threading.Thread(target=hammer) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(statuses) == 6 * len(frames)


def test_other_threads_run_meanwhile(frames, camera):
    """The interpreter's lock is free while a frame is judged: a thread of Python counts on."""
    sys_interval = sys.getswitchinterval()
    sys.setswitchinterval(10)  # only a lock that is given back lets the other thread run
    counted = [0]
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            stop.wait(0.0005)
    counter = threading.Thread(target=count)
    try:
        counter.start()
        before = counted[0]
        run(frames, camera)
        during = counted[0] - before
    finally:
        stop.set()
        counter.join()
        sys.setswitchinterval(sys_interval)
    assert during >= 3


def test_motion_that_is_none(frame_filter):
    far = np.eye(4)
    far[0, 3] = 1e9  # nanometres
    with pytest.raises(stillpoint.Error, match="^current_from_reference moves by more than 100 m, expected metres"):
        frame_filter.expect_motion(far)
