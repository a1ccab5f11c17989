#include "reports/html/assets.h"

namespace volumark {

// Made by vm_embed_text from the files of this folder.
const char* html_page_html();
const char* html_light_css();
const char* html_dark_css();
const char* html_page_css();
const char* html_answers_css();
const char* html_tables_css();
const char* html_bars_css();
const char* html_plot_css();
const char* html_viewer_css();
const char* html_print_css();
const char* html_base_js();
const char* html_pictures_js();
const char* html_tables_js();
const char* html_details_js();
const char* html_plots_js();
const char* html_viewer_state_js();
const char* html_viewer_draw_js();
const char* html_viewer_pixels_js();
const char* html_viewer_js();
const char* html_viewer_keys_js();
const char* html_spots_js();
const char* html_main_js();

namespace html {

const char* page_template() { return html_page_html(); }

std::string style_text() {
  const std::string light = html_light_css(), dark = html_dark_css();
  return ":root{" + light + "}\n@media (prefers-color-scheme: dark){:root:not([data-theme=light]){" + dark +
         "}}\n:root[data-theme=dark]{" + dark + "}\n" + html_page_css() + html_answers_css() + html_tables_css() +
         html_bars_css() + html_plot_css() + html_viewer_css() + "@media print{:root,:root[data-theme=dark]{" + light +
         "}\n" + html_print_css() + "}\n";
}

std::string script_text() {
  std::string out;
  for (const char* part : {html_base_js(), html_pictures_js(), html_tables_js(), html_details_js(), html_plots_js(),
                           html_viewer_state_js(), html_viewer_draw_js(), html_viewer_pixels_js(), html_viewer_js(),
                           html_viewer_keys_js(), html_spots_js(), html_main_js()})
    out += part;
  return out;
}

}  // namespace html
}  // namespace volumark
