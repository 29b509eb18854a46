"""Checks results of mdofd strictly against the schemas of rpc.discover, with python3-jsonschema. A schema states
only names and types of members. Therefore, if several results have the same names and types, only one of them
is checked."""
import jsonschema


def methods(client):
    """The methods of all pages of rpc.discover."""
    offset, found = 0, []
    while offset is not None:
        page = client.call("rpc.discover", offset=offset)
        found += page["methods"]
        offset = page.get("x-next-offset")
    return found


def form(value):
    """The names and types of the members of a value."""
    if isinstance(value, dict):
        return tuple(sorted((key, form(x)) for key, x in value.items()))
    if isinstance(value, list):
        return frozenset(form(x) for x in value)
    return "integer" if isinstance(value, float) and value.is_integer() else type(value).__name__


class Schemas:
    def __init__(self, client):
        self.of = {m["name"]: m["result"]["schema"] for m in methods(client)}
        self.checks = {name: jsonschema.Draft7Validator(schema) for name, schema in self.of.items()}
        self.right = set()

    def wrong(self, method, result):
        """The errors of the result; each is a text."""
        if method not in self.checks or (key := (method, form(result))) in self.right:
            return []
        found = [f"{method}: /{'/'.join(map(str, e.absolute_path))}: {e.message[:300]}"
                 for top in self.checks[method].iter_errors(result) for e in (top.context or [top])]
        if not found:
            self.right.add(key)
        return found
