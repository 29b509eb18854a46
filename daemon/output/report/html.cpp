#include "daemon/output/report/html.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "daemon/output/charts/svg.h"

namespace mdof::report {
namespace {

using charts::xml_escaped;

std::string policy(bool pictures) {
  return std::string(
             "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; ") +
         "style-src 'unsafe-inline'" + (pictures ? "; img-src data:" : "") + "\">\n";
}

constexpr std::string_view kStyle =
    "@page{size:A4;margin:16mm 14mm}"
    "body{font:10pt/1.4 system-ui,'DejaVu Sans',Arial,sans-serif;color:#1f2328;background:#fff;"
    "max-width:182mm;margin:8mm auto;padding:0 4mm}"
    "header{margin:0 0 6mm}header img{max-height:20mm}"
    "h1{font-size:15pt;margin:0 0 4mm}"
    "h2{font-size:14pt;margin:9mm 0 3mm;border-bottom:.4mm solid #6e7781}"
    "h3{font-size:11pt;margin:6mm 0 2mm}"
    "h1,h2,h3{break-after:avoid}"
    ".alarm{font-weight:600;color:#b3261e;border:.4mm solid #b3261e;padding:1.5mm 3mm;"
    "margin:0 0 2mm}"
    "dl{display:grid;grid-template-columns:46mm 1fr;gap:.6mm 4mm;margin:0;break-inside:avoid}"
    "dt{color:#59636e}dd{margin:0;overflow-wrap:anywhere}"
    "table{border-collapse:collapse;width:100%;font-size:8.5pt;break-inside:avoid}"
    "table.long{break-inside:auto;font-size:7.5pt}"
    "table.points{font-size:7pt}table.tight td:not(:last-child){white-space:nowrap}"
    "td:first-child{white-space:nowrap}"
    "dl+table{margin-top:2mm}"
    "thead{display:table-header-group}tr{break-inside:avoid}"
    "th{text-align:left;border-bottom:.4mm solid #1f2328;font-weight:600;vertical-align:bottom}"
    "td{border-bottom:.2mm solid #d0d7de;vertical-align:top;overflow-wrap:anywhere}"
    "th,td{padding:.7mm 1.4mm}"
    "table.numbers td:not(:first-child),table.numbers th:not(:first-child){text-align:right}"
    "figure{margin:3mm 0;break-inside:avoid}figure svg{width:100%;height:auto}"
    "pre{font-size:7.5pt;white-space:pre-wrap;overflow-wrap:anywhere;background:#f6f8fa;"
    "padding:2mm;margin:2mm 0}"
    ".end{text-align:center;margin-top:6mm}"
    "@page{@bottom-left{font:7.5pt sans-serif}@bottom-right{font:7.5pt sans-serif}}"
    "p{margin:1.5mm 0}.quiet{color:#59636e}"
    "@media print{body{margin:0;padding:0;max-width:none}"
    "*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}";

std::string base64(std::string_view bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // OpenSSL appends a NUL
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

}  // namespace

std::string css_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    char code[8];
    std::snprintf(code, sizeof code, "\\%x ", byte);
    escaped += byte < 128 && !std::isalnum(byte) ? std::string(code) : std::string(1, c);
  }
  return escaped;
}

void Html::element(std::string_view tag, std::string_view text, std::string_view css_class) {
  const std::string name(tag);
  text_ += '<' + name;
  if (!css_class.empty()) text_ += " class=\"" + std::string(css_class) + '"';
  text_ += '>';
  if (tag == "pre") {  // in the element "pre", line ends are kept
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      text_ += xml_escaped(text.substr(at, end - at)) + (end < text.size() ? "\n" : "");
      at = end + 1;
    }
  } else {
    text_ += xml_escaped(text);
  }
  text_ += "</" + name + ">\n";
}

void Html::facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  text_ += "<dl>\n";
  for (const auto& [name, value] : facts)
    if (!value.empty())
      text_ += "<dt>" + xml_escaped(name) + "</dt><dd>" + xml_escaped(value) + "</dd>\n";
  text_ += "</dl>\n";
}

void Html::attachment(std::string_view text, std::string_view file_name,
                      std::string_view media_type, std::string_view bytes) {
  text_ += "<p><a download=\"" + xml_escaped(file_name) +
           "\" href=\"data:" + xml_escaped(media_type) + ";base64," + base64(bytes) + "\">" +
           xml_escaped(text) + "</a></p>\n";
}

void Html::table(const std::vector<std::string>& head,
                 const std::vector<std::vector<std::string>>& rows, std::string_view css_class) {
  text_ += "<table";
  if (!css_class.empty()) text_ += " class=\"" + std::string(css_class) + '"';
  text_ += ">\n<thead><tr>";
  for (const std::string& cell : head) text_ += "<th>" + xml_escaped(cell) + "</th>";
  text_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    text_ += "<tr>";
    for (const std::string& cell : row) text_ += "<td>" + xml_escaped(cell) + "</td>";
    text_ += "</tr>\n";
  }
  text_ += "</tbody></table>\n";
}

void Html::figure(std::string_view svg) {
  text_ += "<figure>\n";
  text_ += svg.substr(svg.find("<svg"));
  text_ += "</figure>\n";
}

std::string Html::take(std::string_view language, std::string_view title, bool pictures,
                       std::string_view style) {
  return "<!DOCTYPE html>\n<html lang=\"" + std::string(language) +
         "\">\n<head>\n<meta charset=\"utf-8\">\n" + policy(pictures) +
         "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" + xml_escaped(title) +
         "</title>\n<style>" + std::string(kStyle) + std::string(style) +
         "</style>\n</head>\n<body>\n" + std::move(text_) + "</body>\n</html>\n";
}

}  // namespace mdof::report
