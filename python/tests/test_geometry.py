import pickle

import numpy as np
import pytest

import tanglebin

TURNED = np.array([[0, -1, 0, 1.0], [1, 0, 0, 2.0], [0, 0, 1, 3.0], [0, 0, 0, 1]])


def a_bent_tube():
    return tanglebin.Tube([[0, 0, 0.1], [0.2, 0, 0.1], [0.2, 0.1, 0.1]], radius=0.0125, id=4)


def test_a_tube_is_made_of_its_centre_line():
    tube = a_bent_tube()
    assert (tube.id, tube.radius, tube.mass, tube.flat_ends) == (4, 0.0125, 0, False)
    assert tube.nodes.shape == (3, 3) and tube.nodes.dtype == np.float64
    np.testing.assert_array_equal(tube.edges, [[0, 1], [1, 2]])
    np.testing.assert_array_equal(tube.node_ids, [1, 3, 2])  # the ends are named 1 and 2
    assert tube.length == pytest.approx(0.3)
    (line,) = tube.centre_lines
    np.testing.assert_array_equal(line, tube.nodes)


def test_a_tree_has_a_centre_line_for_each_branch():
    nodes = [[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0], [0.2, 0.1, 0], [0.2, -0.1, 0]]
    tree = tanglebin.Tube(nodes, 0.01, edges=[(0, 1), (1, 2), (2, 3), (2, 4)])
    assert sorted(len(line) for line in tree.centre_lines) == [2, 2, 3]


def test_nodes_and_edges_are_in_the_tubes_memory():
    tube = a_bent_tube()
    tube.nodes[2] = [0.2, 0.3, 0.1]
    assert tube.length == pytest.approx(0.5)
    nodes = tube.nodes
    assert np.shares_memory(nodes, tube.nodes) and not nodes.flags.owndata
    del tube
    assert nodes[2, 1] == 0.3  # the array keeps the tube alive


@pytest.mark.parametrize(
    "arguments, message",
    [
        (dict(nodes=[[0, 0]], radius=0.01), r"nodes: found an array of shape \(1, 2\), expected n x 3"),
        (dict(nodes=[[0, 0, 0], [0, 0, np.nan]], radius=0.01), "nodes of tube 1: found a position that is not finite"),
        (dict(nodes=[[0, 0, 0], [0, 0, 1]], radius=-1), "radius of tube 1: found -1, expected a positive number"),
        (dict(nodes=[[0, 0, 0], [0, 0, 1]], radius=1, edges=[(0, 2)]), "edges of tube 1: found 2, expected the index"),
        (dict(nodes=[[0, 0, 0], [0, 0, 1]], radius=1, edges=[(0, 1), (1, 0)]), "edges of tube 1: found no tree"),
    ],
)
def test_what_is_no_tube_is_refused(arguments, message):
    with pytest.raises(tanglebin.InputError, match=message):
        tanglebin.Tube(**arguments)


def spoilt(**members):
    tube = tanglebin.Tube([[0, 0, 0.2], [0.1, 0, 0.2]], 0.01, mass=0.1)
    for name, value in members.items():
        if name in ("nodes", "edges"):
            getattr(tube, name)[0, 0] = value
        else:
            setattr(tube, name, value)
    return tube


@pytest.mark.parametrize("members", [dict(nodes=np.nan), dict(radius=0), dict(radius=np.nan), dict(edges=10**12)])
@pytest.mark.parametrize(
    "use",
    [
        lambda tube: tube.length,
        lambda tube: tube.centre_lines,
        lambda tube: tanglebin.mesh_of(tube),
        lambda tube: tanglebin.settle([tube]),
        lambda tube: tanglebin.fault_of_heap([tube]),
        lambda tube: tanglebin.spawn(tanglebin.Rng(1), [tube], tanglebin.Bin()),
        lambda tube: tanglebin.score_tubes([tube], [a_bent_tube()]),
        lambda tube: tanglebin.scan([tube], tanglebin.Bin(), tanglebin.camera_preset("paper")),
        lambda tube: tanglebin.largest_tube_overlap([tube]),
        lambda tube: tanglebin.largest_bin_overlap([tube], tanglebin.Bin()),
        lambda tube: tanglebin.write_configuration("/dev/null", [tube]),
    ],
)
def test_a_tube_that_was_spoilt_is_refused_wherever_it_goes(use, members):
    (field,) = members
    with pytest.raises(tanglebin.InputError, match=f"{field} of tube 1"):
        use(spoilt(**members))


@pytest.mark.parametrize("members", [dict(nodes=np.nan), dict(edges=10**12)])
def test_a_model_that_was_spoilt_is_not_scored(members):
    with pytest.raises(tanglebin.InputError, match=f"{next(iter(members))} of tube 1"):
        tanglebin.score_tubes([a_bent_tube()], [spoilt(**members)])


@pytest.mark.parametrize("mass", [0, np.nan, 1e300, 1e-320])
def test_a_mass_that_cannot_be_simulated_is_refused(mass):
    for use in (tanglebin.settle, tanglebin.fault_of_heap):
        with pytest.raises(tanglebin.InputError, match="mass of tube 1"):
            use([spoilt(mass=mass)])


def test_tubes_move_as_rigid_bodies():
    moved = a_bent_tube().transformed(TURNED)
    np.testing.assert_allclose(moved.nodes[1], [1, 2.2, 3.1])
    with pytest.raises(tanglebin.InputError, match="motion: found a matrix that is no rigid motion"):
        moved.transformed(2 * np.eye(4))
    with pytest.raises(tanglebin.InputError, match=r"motion: found an array of shape \(3, 3\)"):
        moved.transformed(np.eye(3))


def test_a_mesh_shares_its_memory():
    mesh = tanglebin.mesh_of(a_bent_tube())
    assert isinstance(mesh, tanglebin.TubeMesh) and mesh.label == 4
    assert mesh.vertices.dtype == np.float32 and mesh.triangles.dtype == np.uint32
    assert mesh.triangles.max() == len(mesh.vertices) - 1
    assert np.shares_memory(mesh.vertices, mesh.vertices)


def test_cameras_look_where_they_are_said_to():
    focal_length = tanglebin.focal_length_from_hfov(640, np.pi / 2)
    assert focal_length == pytest.approx(320)
    camera = tanglebin.downward_camera(640, 480, focal_length, [0.1, 0.2, 2])
    np.testing.assert_array_equal(camera.pose, [[1, 0, 0, 0.1], [0, -1, 0, 0.2], [0, 0, -1, 2], [0, 0, 0, 1]])
    assert camera.intrinsics == tanglebin.Intrinsics(640, 480, camera.fx, camera.fy, 319.5, 239.5)
    same = tanglebin.Camera(640, 480, camera.fx, camera.fy, camera.cx, camera.cy, pose=camera.pose)
    assert same == camera and same != tanglebin.camera_preset("kinect-v1")
    same.pose = TURNED
    np.testing.assert_array_equal(same.pose, TURNED)
    with pytest.raises(tanglebin.InputError, match="scanner"):
        tanglebin.Camera(0, 480, 320, 320, 320, 240)


def test_bins_and_supports():
    bin = tanglebin.bin_preset("paper")
    assert bin == tanglebin.Bin() and (bin.length, bin.width, bin.height) == (0.55, 0.37, 0.2)
    with pytest.raises(tanglebin.InputError, match="'pper'"):
        tanglebin.bin_preset("pper")
    table = tanglebin.Support("plane", pose=TURNED, margin=0.001)
    assert table.shape == "plane" and table.margin == 0.001
    np.testing.assert_array_equal(table.pose, TURNED)
    with pytest.raises(tanglebin.InputError, match="support.margin"):
        tanglebin.Support("bin", bin=bin, margin=-1)


def test_workers_can_be_sent_all_of_it():
    for thing in [tanglebin.Bin(length=1), tanglebin.camera_preset("zivid-one-plus-l")]:
        assert pickle.loads(pickle.dumps(thing)) == thing
    tube = a_bent_tube()
    copy = pickle.loads(pickle.dumps(tube))
    assert (copy.id, copy.radius) == (tube.id, tube.radius)
    np.testing.assert_array_equal(copy.nodes, tube.nodes)
    np.testing.assert_array_equal(copy.edges, tube.edges)
