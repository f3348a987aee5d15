#include "render/renderer/aov_channels.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace boule {
namespace {

/// One number of the AOVs.
struct AovKind {
  const char* name;             ///< of its channel
  bool AovSelection::*wanted;   ///< the member that selects it
  float (*value)(const Aovs&);  ///< null: the id
};

constexpr AovKind kinds[] = {
    {"Z", &AovSelection::depth, [](const Aovs& v) { return v.depth; }},
    {"N.X", &AovSelection::normal, [](const Aovs& v) { return v.normal.x; }},
    {"N.Y", &AovSelection::normal, [](const Aovs& v) { return v.normal.y; }},
    {"N.Z", &AovSelection::normal, [](const Aovs& v) { return v.normal.z; }},
    {"P.X", &AovSelection::position, [](const Aovs& v) { return v.position.x; }},
    {"P.Y", &AovSelection::position, [](const Aovs& v) { return v.position.y; }},
    {"P.Z", &AovSelection::position, [](const Aovs& v) { return v.position.z; }},
    {"id", &AovSelection::id, nullptr},
    {"albedo.R", &AovSelection::albedo, [](const Aovs& v) { return v.albedo.r; }},
    {"albedo.G", &AovSelection::albedo, [](const Aovs& v) { return v.albedo.g; }},
    {"albedo.B", &AovSelection::albedo, [](const Aovs& v) { return v.albedo.b; }},
    {"view.Z", &AovSelection::z, [](const Aovs& v) { return v.along; }},
};

}  // namespace

bool AovSelection::any_traced() const { return AovChannels::traced(*this) > 0; }

bool AovSelection::any() const {
  return std::any_of(aov_names.begin(), aov_names.end(),
                     [this](const AovName& aov) { return this->*aov.wanted; });
}

AovChannels::AovChannels(const AovSelection& selection, const PixelRect& rect) : rect_(rect) {
  const auto pixels = static_cast<std::size_t>(rect.area());
  for (std::size_t k = 0; k < std::size(kinds); ++k) {
    if (!(selection.*kinds[k].wanted)) continue;
    kinds_.push_back(k);
    channels_.push_back({kinds[k].name, {}});
    if (kinds[k].value != nullptr) {
      channels_.back().samples.emplace<std::vector<float>>(pixels);
    } else {
      channels_.back().samples.emplace<std::vector<std::uint32_t>>(pixels);
    }
  }
}

void AovChannels::set(int x, int y, const Aovs& aovs) {
  const std::size_t pixel = rect_.index(x, y);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const AovKind& kind = kinds[kinds_[i]];
    if (kind.value != nullptr) {
      std::get<std::vector<float>>(channels_[i].samples)[pixel] = kind.value(aovs);
    } else {
      std::get<std::vector<std::uint32_t>>(channels_[i].samples)[pixel] = aovs.id;
    }
  }
}

std::vector<ImageChannel> AovChannels::release() { return std::exchange(channels_, {}); }

std::vector<std::string> AovChannels::names(const AovSelection& selection) {
  std::vector<std::string> names;
  for (const AovKind& kind : kinds) {
    if (selection.*kind.wanted) names.emplace_back(kind.name);
  }
  if (selection.noise) names.emplace_back("noise");
  if (selection.samples) names.emplace_back("samples");
  return names;
}

std::size_t AovChannels::traced(const AovSelection& selection) {
  return static_cast<std::size_t>(
      std::count_if(std::begin(kinds), std::end(kinds),
                    [&](const AovKind& kind) { return selection.*kind.wanted; }));
}

std::uint64_t AovChannels::bytes(const AovSelection& selection, const PixelRect& rect) {
  return rect.area() * names(selection).size() * sizeof(float);
}

std::vector<ImageChannel> measured_channels(const AovSelection& selection,
                                            const MeasuredPicture& picture) {
  std::vector<ImageChannel> channels;
  if (selection.noise) channels.push_back({"noise", picture.noise()});
  if (selection.samples) channels.push_back({"samples", picture.samples()});
  return channels;
}

}  // namespace boule
