"""The tube in YADE, with the contact law of riesel under contact.slip: spring and contact.attraction: clip:

    F_N = max(0, k_n overlap + gamma_n m_red d(overlap)/dt)
    F_S = a tangential spring of stiffness k_t, at most mu F_N; discs do not rotate

    yade -n -x -j THREADS tube_yade.py STATE.npz ANSWER.json WARM_UP STEPS SKIN

Of two bodies in contact YADE takes p1 p2 / (p1 + p2) of stiffnesses and dampings: so each has twice the stiffness, each
free grain the damping gamma_n m of its own, and a wall grain, as infinitely heavy, as good as infinitely much of it.
"""

import json
import math
import sys
import time

import numpy as np

path, answer, warm_up, steps, skin = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), float(sys.argv[5])
given = np.load(path)
value = {name: float(given[name]) for name in ("width", "length", "time_step", "gravity", "k_n", "k_t", "gamma_n", "mu")}
margin = 2.0 * max(given["radius"].max(), given["wall_radius"].max())


def material(damping):
    return ViscElMat(kn=2.0 * value["k_n"], ks=2.0 * value["k_t"], cn=damping, cs=0.0,
                     frictionAngle=math.atan(value["mu"]), density=1.0)


def grain(position, radius, damping, fixed):
    body = utils.sphere((position[0] + margin, position[1], margin), radius, material=material(damping), fixed=fixed)
    if fixed:
        body.mask = 3  # free grains have bit 1; bodies that share bit 2 are not looked at: avoidSelfInteractionMask
    return body


def free_grain(position, velocity, radius, mass):
    body = grain(position, radius, value["gamma_n"] * mass, fixed=False)
    body.state.mass = mass
    body.state.vel = (velocity[0], velocity[1], 0.0)
    body.state.blockedDOFs = "zXYZ"
    return body


O.periodic = True
O.cell.setBox(value["width"] + 2.0 * margin, value["length"], 2.0 * margin)
free = O.bodies.append([free_grain(p, v, float(r), float(m)) for p, v, r, m in
                        zip(given["position"].tolist(), given["half_step_velocity"].tolist(), given["radius"], given["mass"])])
infinite = 1e6 * value["gamma_n"] * float(given["mass"].max())
O.bodies.append([grain(p, float(r), infinite, fixed=True)
                 for p, r in zip(given["wall_position"].tolist(), given["wall_radius"])])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=skin, sortAxis=1, allowBiggerThanPeriod=True,
                          avoidSelfInteractionMask=2),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0.0, gravity=(0.0, value["gravity"], 0.0))]
O.dt = value["time_step"]


def take_over_springs():
    """Those of contacts that there are already. They turn with a contact: +k_t spring along (-n_y, n_x), whoever is first."""
    for (first, second), spring in zip(given["touching"].tolist(), given["spring"].tolist()):
        if O.interactions.has(first, second, onlyReal=True):
            contact = O.interactions[first, second]
            n = contact.geom.normal
            contact.phys.shearForce += value["k_t"] * spring * Vector3(-n[1], n[0], 0.0)


def advance(count):
    for _ in range(count):
        O.step()  # O.run() looks every 40 ms whether it is done


advance(1)  # now contacts are there
take_over_springs()
advance(warm_up - 1)
begin = time.perf_counter()
advance(steps if warm_up > 0 else steps - 1)
seconds = time.perf_counter() - begin


def velocities():
    return np.array([O.bodies[i].state.vel for i in free])


# Velocities are those half a step before the positions, and contacts as they were when forces were computed.
before = velocities()
O.step()
velocity = 0.5 * (before + velocities())
masses = np.array([O.bodies[i].state.mass for i in free])
count = len(free)  # a contact counts once for each free grain
contacts = sum((c.id1 < count) + (c.id2 < count) for c in O.interactions if c.isReal and c.geom.penetrationDepth > 0.0)
with open(answer, "w", encoding="utf-8") as file:
    json.dump({"seconds": seconds, "too_late": 0,
               "state": {"mean_vx": velocity[:, 0].mean(), "mean_vy": velocity[:, 1].mean(),
                         "kinetic_energy": 0.5 * float(masses @ (velocity**2).sum(axis=1)),
                         "contacts_of_grains": float(contacts)}}, file)
