#include "sim_host/page/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace morepro::host {
namespace {

constexpr PageParts kPage{"test", "<!doctype html><body>", "</body>", {}};

/// What a browser takes for the content of the data element: everything up to the first end of a script.
std::string data_of(const std::string& html) {
  const std::string start = "id=\"data\">";
  const std::size_t from = html.find(start) + start.size();
  return html.substr(from, html.find("</script", from) - from);
}

TEST(Page, TextInTheDataCannotEndItsElement) {
  for (const std::string text :
       {"</script><script>alert(1)</script>", "<!-- <script>", "</SCRIPT >", "a < b", "\u2028"}) {
    const nlohmann::json data{{text, text}};
    const std::string html = page_html(kPage, data.dump());
    EXPECT_EQ(nlohmann::json::parse(data_of(html)), data) << text;
    EXPECT_EQ(data_of(html).find('<'), std::string::npos) << text;
  }
}

TEST(Page, KeepsWhatStandsAroundTheData) {
  const std::string html = page_html(kPage, "{}");
  EXPECT_TRUE(html.starts_with(kPage.before_data));
  EXPECT_TRUE(html.ends_with(kPage.after_data));
}

TEST(Page, SaysWhyItIsNotThere) {
  EXPECT_EQ(why_no_page(kPage), "");
  EXPECT_NE(why_no_page({"test", {}, {}, "npm is ill"}).find("npm is ill"), std::string::npos);
}

}  // namespace
}  // namespace morepro::host
