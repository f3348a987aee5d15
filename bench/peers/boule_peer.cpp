#include "bench/peers/boule_peer.h"

#include <algorithm>
#include <utility>

#include "bench/scenes/camera_rays.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

class BouleContender final : public Contender {
 public:
  struct Memory {
    HitBuffer* hits;
    AlignedArray<std::uint8_t>* occluded;
  };

  BouleContender(Info info, const Workload& workload, const GeometryView& geometry,
                 const KernelTable& kernels, const Query& query, Memory memory)
      : Contender(std::move(info)),
        workload_(workload),
        geometry_(geometry),
        kernels_(kernels),
        query_(query),
        memory_(memory) {}

  void prepare() override {
    for (std::size_t i = 0; i < workload_.rays->size(); ++i) {
      (*memory_.occluded)[i] = 2;
      memory_.hits->view().id[i] = -2;
    }
  }

  void trace(std::size_t first, std::size_t last) override {
    const RayStream rays = workload_.rays->view();
    const std::size_t stream_size = info().width;
    Experience experience;
    Query query = query_;
    query.experience = &experience;
    for (; first < last; first += stream_size) {
      const RayStream stream = boule::part(rays, first, std::min(stream_size, last - first));
      if (asks_any(workload_.kind)) {
        kernels_.any_hit(geometry_, stream, query, memory_.occluded->data() + first);
      } else {
        const HitStream all = memory_.hits->view();
        kernels_.closest_hit(geometry_, stream, query, boule::part(all, first, stream.size));
      }
    }
  }

  void answer(Answers& answers) const override {
    const std::size_t size = workload_.rays->size();
    if (asks_any(workload_.kind)) {
      answers.occluded.assign(memory_.occluded->data(), memory_.occluded->data() + size);
      return;
    }
    answers.hits.resize(size);
    for (std::size_t i = 0; i < size; ++i) answers.hits[i] = memory_.hits->get(i);
  }

 private:
  Workload workload_;
  GeometryView geometry_;
  const KernelTable& kernels_;
  Query query_;
  Memory memory_;
};

}  // namespace

BoulePeer::BoulePeer(const BenchScene& scene, std::vector<std::string> isas)
    : geometry_(scene.spheres, {}), isas_(std::move(isas)) {
  if (!scene.capsules.empty()) geometry_.add_capsules(scene.capsules);
}

std::vector<std::unique_ptr<Contender>> BoulePeer::contenders(const Workload& workload) {
  hits_.resize(workload.rays->size());
  occluded_.resize(workload.rays->size());
  std::vector<std::unique_ptr<Contender>> all;
  const std::size_t stream_size = block_size(workload);  // the renderer's
  for (const std::string& isa : isas_) {
    const KernelTable& kernels = *select_kernels(isa).value();
    const auto add = [&](const char* suffix, const Query& query) {
      const bool fast = query.solver == Solver::fast;
      Contender::Info info = {"boule-" + isa + suffix,  isa,   stream_size,
                              fast ? "fast" : "robust", false, !fast};
      all.push_back(std::make_unique<BouleContender>(std::move(info), workload, geometry_.view(),
                                                     kernels, query,
                                                     BouleContender::Memory{&hits_, &occluded_}));
    };
    const Coherence coherence = coherence_of(workload.kind);
    add("", {Solver::robust, Form::automatic, coherence});
    add("-single", {Solver::robust, Form::single, Coherence::none});
    add("-flight", {Solver::robust, Form::flight, Coherence::none});
    add("-set", {Solver::robust, Form::set, Coherence::none});
    add("-packet", {Solver::robust, Form::packet, Coherence::none});
    if (isa == "avx2") add("-fast", {Solver::fast, Form::packet, Coherence::none});
  }
  return all;
}

}  // namespace boule::bench
