#include "bench/report/page_parts.h"

#include "bench/report/chart.h"
#include "bench/report/chart_colors.h"

namespace boule::bench {
namespace {

std::string row_of(const std::vector<std::string>& cells, const std::string& tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    const bool number =
        !cell.empty() && cell.find_first_not_of("0123456789.e+-|inf ") == std::string::npos;
    html += "<" + tag + (number ? " class=\"number\">" : ">") + escaped(cell) + "</" + tag + ">";
  }
  return html + "</tr>\n";
}

constexpr const char* page_style = R"(
:root { color-scheme: light dark; --page: #fff; --ink: #222; --faint: #d8d8d8; --soft: #f5f6f7; }
@media (prefers-color-scheme: dark) {
  :root { --page: #15181b; --ink: #e6e6e6; --faint: #3c4043; --soft: #1e2226; } }
body { background: var(--page); color: var(--ink); font: 16px/1.5 system-ui, sans-serif;
  max-width: 60rem; margin: 0 auto; padding: 1rem; overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { margin-top: 2.5rem; font-size: 1.3rem; }
figure { margin: 1.2rem 0; } svg.chart { display: block; width: 100%; height: auto; }
svg.key { display: inline-block; width: 1rem; height: 1rem; vertical-align: -0.15rem;
  margin-right: 0.3rem; }
.legend { font-size: 0.85rem; margin: 0.2rem 0 0; }
.legend span { display: inline-block; margin-right: 1rem; white-space: nowrap; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: 0.85rem; overflow-wrap: normal; }
th, td { border-bottom: 1px solid var(--faint); padding: 0.25rem 0.6rem; text-align: left;
  vertical-align: top; }
th { background: var(--soft); } .number { text-align: right; white-space: nowrap;
  font-variant-numeric: tabular-nums; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem; }
.pictures figure { margin: 0; } .pictures img { width: 100%; height: auto;
  image-rendering: pixelated; } figcaption { font-size: 0.85rem; }
#tip { position: fixed; display: none; max-width: min(22rem, 90vw); padding: 0.35rem 0.6rem;
  background: var(--ink); color: var(--page); font-size: 0.85rem; border-radius: 0.25rem;
  pointer-events: none; z-index: 1; }
@media (max-width: 40rem) { .chart { font-size: 19px; } .chart .title { font-size: 21px; }
  .chart .label, .chart .leader { display: none; }
  body { padding: 0.7rem; } }
)";

// Shows data-tip of what is pointed at, touched or reached by keyboard.
constexpr const char* page_script = R"(
const tip = document.getElementById('tip');
const show = event => {
  const target = event.target.closest ? event.target.closest('[data-tip]') : null;
  if (!target) { tip.style.display = 'none'; return; }
  tip.textContent = target.dataset.tip;
  tip.style.display = 'block';
  const at = target.getBoundingClientRect(), size = tip.getBoundingClientRect();
  const x = at.left + at.width / 2 - size.width / 2;
  const y = at.top - size.height - 6;
  tip.style.left = Math.max(4, Math.min(x, innerWidth - size.width - 4)) + 'px';
  tip.style.top = (y < 4 ? at.bottom + 6 : y) + 'px';
};
for (const kind of ['pointerover', 'pointerdown', 'focusin'])
  document.addEventListener(kind, show);
document.addEventListener('scroll', () => { tip.style.display = 'none'; });
)";

}  // namespace

std::string Table::html() const {
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table>\n";
  bool named = false;
  for (const std::string& name : head_) named = named || !name.empty();
  if (named) html += row_of(head_, "th");
  for (const auto& row : rows_) html += row_of(row, "td");
  return html + "</table></div>\n";
}

std::string page_head(const std::string& title) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" +
         escaped(title) +
         "</title>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<style>" +
         chart_style() + page_style + "</style></head>\n<body>\n";
}

std::string page_end() {
  return std::string("<div id=\"tip\" role=\"tooltip\"></div>\n<script>") + page_script +
         "</script>\n</body></html>\n";
}

std::string section(const std::string& title, const std::string& html) {
  return "<section><h2>" + escaped(title) + "</h2>\n" + html + "</section>\n";
}

}  // namespace boule::bench
