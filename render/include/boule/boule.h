#pragma once

/// All of Boule that a program needs: scenes from files or from memory, pictures, rays and their
/// hits. Each header can be included by itself as well, by the path below.

#include "core/base/float_environment.h"  // FloatEnvironment: what kernels compute in
#include "core/reference.h"        // closest_hit(): the hits that all others are held against
#include "core/scene/instances.h"  // expand_instances(): a scene without groups
#include "core/scene/scene.h"      // Scene: what there is to see
#include "render/frame/partial_picture.h"  // partial_picture(): of a render that goes on
#include "render/image/read_image.h"       // read_image()
#include "render/image/write_image.h"      // write_image()
#include "render/renderer/renderer.h"      // Renderer: a scene to a picture
#include "render/renderer/tracer.h"        // Tracer: rays to hits, on all cores
#include "render/scene_file/scene_file.h"  // load_scene()
#include "simd/dispatch/dispatch.h"        // select_kernels(): rays to hits, on one core
#include "simd/geometry/geometry.h"        // Geometry: the spheres and planes of such a search
#include "simd/stream/stream_buffer.h"     // RayBuffer, HitBuffer: its rays and hits
