#pragma once

/// The whole interface of Boule: scenes from files or from memory, pictures, rays and their hits.
/// You can also include each header by itself, by the path below.

#include "core/base/float_environment.h"         // FloatEnvironment: the float settings of kernels
#include "core/reference.h"                      // closest_hit(): the reference for all hits
#include "core/scene/instances.h"                // expand_instances(): a scene without groups
#include "core/scene/scene.h"                    // Scene: camera, objects, materials, lights
#include "render/files/scene_file/scene_file.h"  // load_scene()
#include "render/frame/partial_picture.h"        // partial_picture(): of an unfinished render
#include "render/image/read_image.h"             // read_image()
#include "render/image/write_image.h"            // write_image()
#include "render/renderer/renderer.h"            // Renderer: a scene to a picture
#include "render/renderer/tracer.h"              // Tracer: rays to hits, on all cores
#include "simd/dispatch/dispatch.h"              // select_kernels(): rays to hits, on one core
#include "simd/geometry/geometry.h"     // Geometry: the spheres and planes of such a search
#include "simd/stream/stream_buffer.h"  // RayBuffer, HitBuffer: its rays and hits
