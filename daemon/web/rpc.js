// Calls methods of mdofd by POST /rpc. The token is stored only in this tab, and sent only in a
// header field.
import {ask, field, h} from "./dom.js";

const kForbidden = -32003;
let id = 0;
let asking = null;  // the dialog while it is open

export class RpcError extends Error {
  constructor(error) {
    super(error.message);
    this.code = error.code;
    this.data = error.data;
  }
}

async function post(method, params) {
  const headers = {"Content-Type": "application/json"};
  const token = sessionStorage.getItem("token");
  if (token) headers.Authorization = `Bearer ${token}`;
  const body = JSON.stringify({jsonrpc: "2.0", id: ++id, method, params});
  let reply;
  try {
    const response = await fetch("/rpc", {method: "POST", headers, body});
    const text = await response.text();
    try {
      reply = JSON.parse(text);
    } catch {
      throw new RpcError({code: 0, message: `${method}: HTTP ${response.status}: ${text.slice(0, 200)}`});
    }
  } catch (error) {
    if (error instanceof RpcError) throw error;
    throw new RpcError({code: 0, message: `${method}: mdofd does not answer; mdofd may be stopped or starting`});
  }
  if (reply.error) throw new RpcError(reply.error);
  return reply.result;
}

export async function askToken(reason) {
  asking ??= ask("Token", [
    reason ? h("p", {class: "notice doubtful"}, reason) : null,
    h("p", {}, "mdofd accepts changes only with its token. To print the token, run ", h("code", {}, "mdof token"),
      " on the computer that runs mdofd, as a user who may read the token file. This page keeps the token until you close the tab."),
    field("Token", h("input", {name: "token", type: "password", autocomplete: "off", required: true, autofocus: true})),
  ], "Use this token");
  const form = await asking;
  asking = null;
  if (!form) return false;
  sessionStorage.setItem("token", String(form.get("token")).trim());
  return true;
}

// Returns the result. Throws RpcError with the message of mdofd. If the method needs a token and
// the tab has no valid token, asks the user for it once.
export async function call(method, params = {}) {
  try {
    return await post(method, params);
  } catch (error) {
    if (error.code !== kForbidden || !/token/i.test(error.message) || !await askToken(error.message)) throw error;
    return post(method, params);
  }
}

// The newest items of a method that lists items in pages, newest first: up to `most` items that `wanted` accepts, from
// the first `search` items. `isAll`: there are no further items.
export async function newest(method, params, key, wanted, most, search = 5000) {
  const items = [];
  for (let read = 0; ;) {
    const page = await call(method, {...params, offset: read});
    read += page[key].length;
    items.push(...page[key].filter(wanted));
    const end = page[key].length === 0 || read >= page.total;
    if (end || items.length > most || read >= search) return {items: items.slice(0, most), searched: read, isAll: end && items.length <= most};
  }
}

// All items of a method that returns its list in pages.
export async function pages(method, params, key, most = 100_000) {
  const items = [];
  for (;;) {
    const page = await call(method, {...params, offset: items.length});
    items.push(...page[key]);
    const total = page.total ?? page.points_total ?? Infinity;  // without a total, the last page is empty
    if (page[key].length === 0 || items.length >= Math.min(total, most)) return {...page, [key]: items};
  }
}
