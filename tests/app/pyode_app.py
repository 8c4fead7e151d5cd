"""A soft cube in a PyODE program: pyode_app.py LIBRARY early|late|preload.

Exits 77 where PyODE is missing. The world is stepped by world.step() alone; the soft body is made
through the C functions of LIBRARY, opened before or after PyODE, or preloaded.
"""
import ctypes
import os
import sys

path, when = sys.argv[1:]
if when == "early":
    soft = ctypes.CDLL(path, mode=os.RTLD_GLOBAL)
try:
    import ode
except ImportError as missing:
    print(f"skipped: {missing}; install python3-pyode and run Debian's own python3")
    sys.exit(77)
if when == "late":
    ode.World().step(0.01)  # ODE's functions are bound by now
if when != "early":
    soft = ctypes.CDLL(path)

real, pointer, integer = ctypes.c_double, ctypes.c_void_p, ctypes.c_int


class Solid(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint)] + [
        (name, real) for name in "young poisson density phi psi alpha beta".split()]


def function(name, result, *arguments):
    f = getattr(soft, name)
    f.restype, f.argtypes = result, arguments
    return f


# The program, as any of PyODE's: a ball above a floor.
world, space = ode.World(), ode.HashSpace()
world.setGravity((0, 0, -9.81))
floor = ode.GeomPlane(space, (0, 0, 1), 0)
ball = ode.Body(world)
ball.setPosition((1, 0, 0.3))
ball_geom = ode.GeomSphere(space, 0.05)
ball_geom.setBody(ball)
met = []


def near(_, first, second):
    met.append((first, second))
    ode.collide(first, second)


# New: a soft cube beside it.
geom = pointer(ball_geom._id())
body = function("dGeomGetBody", pointer, pointer)(geom)
ode_world = function("dBodyGetWorld", pointer, pointer)(body)
ode_space = function("dGeomGetSpace", pointer, pointer)(geom)
soft_world = function("dSoftWorldCreate", pointer, pointer, pointer)(ode_world, ode_space)
hook = function("dSoftWorldGetHook", integer, pointer)(soft_world)
box = function("dSoftMeshCreateBox", pointer, *[real] * 3, *[integer] * 3)
mesh = box(0.1, 0.1, 0.1, 2, 2, 2)
rubber = function("dSoftSolidDefault", Solid)()
rubber.young, rubber.density = 1e6, 1000
cube = function("dSoftBodyCreate", pointer, pointer, pointer, pointer)(
    soft_world, mesh, ctypes.byref(rubber))
function("dSoftBodySetPosition", integer, pointer, *[real] * 3)(cube, 0, 0, 0.3)
center = (real * 4)()
get_center = function("dSoftBodyGetCenterOfMass", None, pointer, pointer)

lowest = 1
for i in range(150):
    space.collide(None, near)
    world.step(0.002)
    get_center(cube, center)
    if i == 49:
        fallen = 0.3 - center[2]
    lowest = min(lowest, center[2])

assert hook == (2 if when == "late" else 1), f"hook {hook}"
assert abs(fallen - 9.81 * 0.1**2 / 2) < 1e-3, f"fell {fallen} m in 0.1 s"
assert 0.03 < lowest < 0.051, f"landed at {lowest} m"
assert all(pair == (floor, ball_geom) or pair == (ball_geom, floor) for pair in met), "strangers"
function("dSoftWorldDestroy", None, pointer)(soft_world)
print(f"{when}: hook {hook}, lowest {lowest:.4f} m")
