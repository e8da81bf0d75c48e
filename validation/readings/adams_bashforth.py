# SPDX-License-Identifier: GPL-2.0-or-later
# The second-order Adams-Bashforth method in the stock LAMMPS, for its fix python/move:
#     x' = x + dt (3 v - v0)/2,  v' = v + dt (3 f - f0)/(2 m),  and the spin of spheres likewise,
# with v0 and f0 of the step before. Forces and velocities are of the same time, as in the paper's conventional method.
# The text goes into a deck between triple quotes, so it has none.
import ctypes

import numpy as np

host = ctypes.CDLL(None)  # this process
address = ctypes.pythonapi.PyCapsule_GetPointer
address.restype, address.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
name = ctypes.pythonapi.PyCapsule_GetName
name.restype, name.argtypes = ctypes.c_char_p, [ctypes.py_object]
extract_atom = host.lammps_extract_atom
extract_atom.restype, extract_atom.argtypes = ctypes.c_void_p, [ctypes.c_void_p, ctypes.c_char_p]
extract_global = host.lammps_extract_global
extract_global.restype, extract_global.argtypes = ctypes.c_void_p, [ctypes.c_void_p, ctypes.c_char_p]


class AdamsBashforth:
    # all particles on one rank; their number must stay and they must not be sorted

    def __init__(self, capsule):
        self.lmp = address(capsule, name(capsule))
        self.before = None

    def init(self):
        self.reset_dt()

    def reset_dt(self):
        self.dt = ctypes.c_double.from_address(extract_global(self.lmp, b"dt")).value

    def vectors(self, array, count):
        rows = ctypes.cast(extract_atom(self.lmp, array), ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))
        return np.ctypeslib.as_array(rows[0], (count, 3))

    def scalars(self, array, count):
        numbers = ctypes.cast(extract_atom(self.lmp, array), ctypes.POINTER(ctypes.c_double))
        return np.ctypeslib.as_array(numbers, (count,))

    def initial_integrate(self, vflag):
        if self.before is None:
            count = ctypes.c_int.from_address(extract_global(self.lmp, b"nlocal")).value
            self.x, self.v, self.omega, self.f, self.torque = (
                self.vectors(array, count) for array in (b"x", b"v", b"omega", b"f", b"torque")
            )
            mass, radius = (self.scalars(array, count) for array in (b"rmass", b"radius"))
            self.per_mass = (1.0 / mass)[:, None]
            self.per_inertia = (2.5 / (mass * radius**2))[:, None]
            self.before = self.rates()  # the first step is Euler's
        rates = self.rates()
        for value, rate, rate_before in zip((self.x, self.v, self.omega), rates, self.before):
            value += self.dt * (1.5 * rate - 0.5 * rate_before)
        self.before = rates

    def rates(self):
        return self.v.copy(), self.per_mass * self.f, self.per_inertia * self.torque

    def final_integrate(self):
        pass
