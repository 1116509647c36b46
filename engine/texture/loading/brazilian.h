#pragma once
// Brazilian test: a disc that lies between flat platens or curved jaws, split by compression across it.
//
// ISRM suggested method (Bieniawski & Hawkes 1978): strength 2 P / (pi D t) of the largest load P on a disc of diameter D
// and thickness t, in jaws with 1.5 times its radius. The disc is a packing on its side: its rim is as smooth as its mould,
// so that it bears on one line of particles at first and on more as it is loaded.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// Keys "brazilian.".
TestEntry brazilian_entry();

/// With standard settings: diameter and thickness of the disc (m), radius of the jaws over that of the disc (0: flat).
Test brazilian(double diameter, double thickness, double jaw_ratio = 1.5);

}  // namespace dem::texture
