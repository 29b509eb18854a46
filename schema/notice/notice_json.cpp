#include "schema/notice/notice_json.h"

#include <simdjson.h>

#include <limits>

namespace mdof {
namespace {

using simdjson::dom::element;

void write(JsonWriter& json, const NoticeValue& x) {
  if (const double* number = std::get_if<double>(&x))
    json.value(*number);
  else
    json.value(std::get<std::string>(x));
}

void write(JsonWriter& json, const Notice& notice, NoticeWords words) {
  json.begin_object()
      .field("code", to_string(notice.code))
      .field("severity", to_string(notice.severity));
  if (!notice.subject.empty()) json.field("subject", notice.subject);
  if (!notice.source.empty()) json.field("source", notice.source);
  for (const auto& [key, x] : notice.values) {
    json.key(key);
    write(json, x);
  }
  if (words) json.field("text", words(notice));
  json.end_object();
}

void write_array(JsonWriter& json, const Notices& notices, NoticeWords words) {
  json.begin_array();
  for (const Notice& notice : notices) write(json, notice, words);
  json.end_array();
}

Notice legacy(std::string_view words) {
  Severity severity = Severity::doubtful;
  for (const Severity each : {Severity::information, Severity::invalid}) {
    const std::string first = std::string(to_string(each)) + ": ";
    if (!words.starts_with(first)) continue;
    words.remove_prefix(first.size());
    severity = each;
  }
  Notice read = notice(NoticeCode::legacy, "", {{"words", std::string(words)}});
  read.severity = severity;
  return read;
}

Severity severity_from(std::string_view name) {
  for (const Severity each : {Severity::information, Severity::invalid})
    if (name == to_string(each)) return each;
  return Severity::doubtful;
}

bool read_value(element item, NoticeValue& x) {
  double number = 0;
  std::string_view text;
  if (!item.get(number))
    x = number;
  else if (!item.get(text))
    x = std::string(text);
  else if (item.is_null())
    x = std::numeric_limits<double>::quiet_NaN();
  else
    return false;
  return true;
}

Result<Notice> read_object(simdjson::dom::object object) {
  Notice read;
  std::string_view code;
  if (object.at_key("code").get(code)) return bad_input("a notice has no code");
  const auto known = notice_code_from(code);
  if (!known) return legacy(code);
  read.code = *known;
  for (const auto& [key, item] : object) {
    NoticeValue x;
    if (!read_value(item, x))
      return bad_input("notice " + std::string(code) + ": " + std::string(key) +
                       " is neither a number nor a text");
    const auto* text = std::get_if<std::string>(&x);
    if (key == "code" || key == "text") continue;
    if (key == "severity")
      read.severity = severity_from(text ? *text : "");
    else if (key == "subject")
      read.subject = text ? *text : "";
    else if (key == "source")
      read.source = text ? *text : "";
    else
      read.values.emplace_back(key, std::move(x));
  }
  return read;
}

Result<Notice> read_item(element item) {
  std::string_view words;
  if (!item.get(words)) return legacy(words);
  simdjson::dom::object object;
  if (item.get(object)) return bad_input("a notice is neither an object nor a text");
  return read_object(object);
}

}  // namespace

void write_notices(JsonWriter& json, const char* key, const Notices& notices, NoticeWords words) {
  json.key(key);
  write_array(json, notices, words);
}

std::string notices_json(const Notices& notices) {
  JsonWriter json;
  write_array(json, notices, nullptr);
  return json.take();
}

Result<Notices> read_notices(std::string_view json_array) {
  Notices read;
  if (json_array == "[]") return read;
  simdjson::dom::parser parser;
  simdjson::dom::array items;
  if (parser.parse(simdjson::padded_string(json_array)).get(items))
    return bad_input("notices are not a JSON array");
  for (const element item : items) {
    MDOF_TRY(Notice one, read_item(item));
    read.push_back(std::move(one));
  }
  return read;
}

}  // namespace mdof
