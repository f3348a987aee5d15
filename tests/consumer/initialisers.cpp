// What callers write: one member of each struct of the interface by its name, the others left out.
// No compiler may warn of those.
#include <boule/boule.h>

namespace {

using namespace boule;

[[maybe_unused]] const Diagnostic diagnostic{.message = "a"};
[[maybe_unused]] const Ray ray{.org = {0, 0, 5}, .dir = {0, 0, -1}};
[[maybe_unused]] const Hit hit{.t = 1};
[[maybe_unused]] const SampleId sample{.x = 1};
[[maybe_unused]] const Similarity similarity{.shift = {1, 0, 0}};

[[maybe_unused]] const Sphere sphere{.center = {1, 2, 3}};
[[maybe_unused]] const Sphere by_radius{.radius = 2};
[[maybe_unused]] const Plane plane{.point = {1, 2, 3}};
[[maybe_unused]] const Plane by_normal{.normal = {0, 0, 1}};
[[maybe_unused]] const Instance instance{.group = 0};
[[maybe_unused]] const Group group{.name = "a"};
[[maybe_unused]] const NamedMaterial named{.name = "a"};
[[maybe_unused]] const Matte matte{.color = {1, 0, 0}};
[[maybe_unused]] const Plastic plastic{.shininess = 3};
[[maybe_unused]] const Metal metal{.color = {1, 0, 0}};
[[maybe_unused]] const Glass glass{.ior = 1.3F};
[[maybe_unused]] const Emissive emissive{.radiance = {1, 0, 0}};
[[maybe_unused]] const Phong phong{.kd = 0.5F};
[[maybe_unused]] const PointLight point{.position = {1, 2, 3}};
[[maybe_unused]] const DirectionalLight directional{.direction = {0, -1, 0}};
[[maybe_unused]] const SphereLight sphere_light{.radius = 2};
[[maybe_unused]] const CameraPose pose{.eye = {1, 2, 3}};
[[maybe_unused]] const PinholeCamera pinhole{.fov = 30};
[[maybe_unused]] const OrthographicCamera orthographic{.height = 3};
[[maybe_unused]] const FisheyeCamera fisheye{.fov = 180};
[[maybe_unused]] const ThinLensCamera thin_lens{.aperture = 0.1F};
[[maybe_unused]] const LensCamera lens{.scale = 1};
[[maybe_unused]] const LensSurface surface{.radius = 1};
[[maybe_unused]] const DistortionMap distortion{.width = 1};
[[maybe_unused]] const CameraFit fit{.fov = 30};
[[maybe_unused]] const ConstantBackground constant{.color = {1, 1, 1}};
[[maybe_unused]] const GradientBackground gradient{.bottom = {1, 1, 1}};
[[maybe_unused]] const EnvironmentBackground environment{.rotation = 30};
[[maybe_unused]] const ImageSettings image_settings{.width = 4};
[[maybe_unused]] const RenderSettings render_settings{.max_depth = 4};
[[maybe_unused]] const Scene scene{.ambient = {1, 1, 1}};
[[maybe_unused]] const Problem problem{.field = "a"};
[[maybe_unused]] const InstanceProblem instance_problem{.instance = 1};
[[maybe_unused]] const PrimitiveCount count{.spheres = 1};
[[maybe_unused]] const ShownGroup shown{.group = 1};

[[maybe_unused]] const Query query{.solver = Solver::fast};
[[maybe_unused]] const RenderOptions render_options{{.width = 4, .height = 3}, {.max_depth = 4}};
[[maybe_unused]] const AovSelection aovs{.depth = true};
[[maybe_unused]] const PixelRect rect{.x1 = 4};
[[maybe_unused]] const StepLimit limit{.seconds = 1};
[[maybe_unused]] const LivePosition position{.pass = 1};
[[maybe_unused]] const TraceOptions trace_options{.threads = 1};
[[maybe_unused]] const TracedHit traced{.t = 1};
[[maybe_unused]] const RayNumbers numbers{.ray_step = 4};
[[maybe_unused]] const RayColumns columns{.size = 1};
[[maybe_unused]] const HitColumns hit_columns{.t = nullptr};
[[maybe_unused]] const SceneFileOptions scene_file_options{.trust = true};
[[maybe_unused]] const LoadedScene loaded{.warnings = {"a"}};
[[maybe_unused]] const ImageFileOptions image_file_options{.exposure_stops = 1};
[[maybe_unused]] const ImageChannel channel{.name = "Z"};
[[maybe_unused]] const CropWindow crop{.frame_width = 4};
[[maybe_unused]] const RecordedRay recorded{.depth = 1};

}  // namespace
