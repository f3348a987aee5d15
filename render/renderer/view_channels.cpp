#include "render/renderer/view_channels.h"

#include <iterator>
#include <utility>

namespace boule {
namespace {

/// One number of a view, its channel's name, and which selection asks for it.
struct Kind {
  const char* name;
  bool ViewSelection::*wanted;
  float (*value)(const View&);  ///< null: the id
};

constexpr Kind kinds[] = {
    {"Z", &ViewSelection::depth, [](const View& v) { return v.depth; }},
    {"N.X", &ViewSelection::normal, [](const View& v) { return v.normal.x; }},
    {"N.Y", &ViewSelection::normal, [](const View& v) { return v.normal.y; }},
    {"N.Z", &ViewSelection::normal, [](const View& v) { return v.normal.z; }},
    {"P.X", &ViewSelection::position, [](const View& v) { return v.position.x; }},
    {"P.Y", &ViewSelection::position, [](const View& v) { return v.position.y; }},
    {"P.Z", &ViewSelection::position, [](const View& v) { return v.position.z; }},
    {"id", &ViewSelection::id, nullptr},
    {"albedo.R", &ViewSelection::albedo, [](const View& v) { return v.albedo.r; }},
    {"albedo.G", &ViewSelection::albedo, [](const View& v) { return v.albedo.g; }},
    {"albedo.B", &ViewSelection::albedo, [](const View& v) { return v.albedo.b; }},
    {"view.Z", &ViewSelection::z, [](const View& v) { return v.along; }},
};

}  // namespace

ViewChannels::ViewChannels(const ViewSelection& selection, const PixelRect& rect) : rect_(rect) {
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

void ViewChannels::set(int x, int y, const View& view) {
  const std::size_t pixel =
      static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
      static_cast<std::size_t>(x - rect_.x0);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Kind& kind = kinds[kinds_[i]];
    if (kind.value != nullptr) {
      std::get<std::vector<float>>(channels_[i].samples)[pixel] = kind.value(view);
    } else {
      std::get<std::vector<std::uint32_t>>(channels_[i].samples)[pixel] = view.id;
    }
  }
}

std::vector<ImageChannel> ViewChannels::release() { return std::exchange(channels_, {}); }

std::vector<std::string> ViewChannels::names(const ViewSelection& selection) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) {
    if (selection.*kind.wanted) names.emplace_back(kind.name);
  }
  return names;
}

std::uint64_t ViewChannels::bytes(const ViewSelection& selection, const PixelRect& rect) {
  std::uint64_t numbers = 0;
  for (const Kind& kind : kinds) numbers += selection.*kind.wanted ? 1 : 0;
  return rect.area() * numbers * sizeof(float);
}

}  // namespace boule
