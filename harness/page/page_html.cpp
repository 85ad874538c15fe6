#include <fmt/format.h>

#include "harness/page/page.h"
#include "harness/page/page_assets.h"
#include "harness/page/page_json.h"

namespace stereobench::harness {
namespace {

/// Nothing is asked of anybody: a page that tried would say so in the browser's console.
constexpr const char* kPolicy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// JSON within a script's element: "</script>" in a text would end it, "<!--" would hide its end.
std::string script_text(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      escaped += "\\u003c";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace

std::string page_html(const Page& page) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n<link rel=\"icon\" href=\"data:,\">\n"
      "<title>stereobench</title>\n<style>\n{}</style>\n</head>\n<body>\n"
      "<noscript>This page is drawn by its script: please allow JavaScript for it.</noscript>\n"
      "<script type=\"application/json\" id=\"page\">{}</script>\n<script>\n{}</script>\n"
      "<script>\n(() => {{\n'use strict';\n{}}})();\n</script>\n</body>\n</html>\n",
      kPolicy, kPageStyle, script_text(page_json(page)), kChartJs, kPageScript);
}

}  // namespace stereobench::harness
