# Bodies of the C interface, which tests compare with the nodes of Godot.
import ctypes

import _native as pelagic


class CBodies:
    def __init__(self, library_file):
        self.library = pelagic.load(library_file)
        self.arrays = []  # those that structs point to

    def call(self, name, *arguments):
        status = getattr(self.library, "pelagic_" + name)(*arguments)
        assert status == pelagic.PELAGIC_OK, f"{name}: {self.library.pelagic_last_error().decode()}"

    def address(self, type_, numbers):
        self.arrays.append((type_ * len(numbers))(*numbers))
        return ctypes.addressof(self.arrays[-1])

    def saved(self, bodies):
        count = ctypes.c_size_t()
        self.call("bodies_save_state", bodies, None, 0, ctypes.byref(count))
        saved = (ctypes.c_uint8 * count.value)()
        self.call("bodies_save_state", bodies, saved, count, ctypes.byref(count))
        return bytes(saved)
