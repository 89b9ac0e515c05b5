#include "sim_host/page/page.hpp"

namespace morepro::host {

std::string why_no_page(const PageParts& page) {
  if (page.why_missing.empty()) return {};
  return "this program was built without its report pages: " + std::string(page.why_missing) +
         ", then build again; the other outputs work";
}

std::string page_html(const PageParts& page, std::string_view json) {
  std::string html(page.before_data);
  html.reserve(html.size() + json.size() + page.after_data.size() + 64);
  html += "<script type=\"application/json\" id=\"data\">";
  // In JSON '<' stands in text only: escaped, nothing there can end the element or open a comment.
  for (const char c : json) {
    if (c == '<') {
      html += "\\u003c";
    } else {
      html += c;
    }
  }
  html += "</script>";
  html += page.after_data;
  return html;
}

}  // namespace morepro::host
