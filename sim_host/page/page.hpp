#pragma once
#include <string>
#include <string_view>

namespace morepro::host {

/// A bundled page of HTML with a gap for its data.
struct PageParts {
  std::string_view name;
  std::string_view before_data;
  std::string_view after_data;
  std::string_view why_missing;  ///< empty: the page is there
};

// One object per folder with a page.html.
extern const PageParts k_diff_page;
extern const PageParts k_kinematics_page;
extern const PageParts k_report_page;
extern const PageParts k_thesis_page;

/// Empty where a page can be written; else a sentence that says why this program cannot, and what to do.
std::string why_no_page(const PageParts& page);

/// The page as one HTML file that needs nothing else. `json` is well-formed JSON; text in it may hold
/// anything, ends of elements and comments included.
std::string page_html(const PageParts& page, std::string_view json);

}  // namespace morepro::host
