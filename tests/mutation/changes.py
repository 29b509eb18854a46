"""Finds the places of a C++ source where tests/mutate can make a small change, and makes these changes.

A change has a plain form (the text that replaces a span) and, if possible, a switched form: edits that do not change
the program until MDOF_CHANGE names the change's number (switch.h).
"""
import dataclasses
import re

TOKEN = re.compile(r'''
    (?P<space>\s+)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<raw>R"(?P<tag>[^(]*)\(.*?\)(?P=tag)")
  | (?P<string>"(?:\\.|[^"\\\n])*")
  | (?P<char>(?<![0-9A-Za-z])'(?:\\.|[^'\\\n])+')
  | (?P<number>(?:0[xX][0-9a-fA-F']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLfzZ]*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<sign><=>|<<=|>>=|->\*|\.\.\.|::|->|\+\+|--|\+=|-=|\*=|/=|%=|&=|\|=|\^=|==|!=|<=|>=|&&|\|\||<<|[^\w\s])
''', re.X | re.S)
OPENS, CLOSES = {'(': ')', '[': ']', '{': '}'}, {')', ']', '}'}
# The arguments of these functions and keywords are texts for people or values for the compiler, so they are not
# changed.
TALKS = {'assert', 'static_assert', 'bad_input', 'fail', 'not_of_this_kind', 'to_string', 'plain_number',
         'reserve', 'alignas', 'sizeof', 'noexcept', 'decltype', 'in_mm', 'in_um'}
KEYWORDS = {'return', 'if', 'else', 'for', 'while', 'do', 'switch', 'case', 'default', 'const', 'constexpr',
            'auto', 'static', 'using', 'struct', 'class', 'enum', 'namespace', 'template', 'typename',
            'inline', 'public', 'private', 'protected', 'friend', 'explicit', 'operator', 'unsigned', 'int',
            'double', 'bool', 'float', 'char', 'void', 'extern', 'mutable', 'virtual', 'try', 'goto'}
BINARY = {'+': [('-', 'plus_minus')], '-': [('+', 'minus_plus')], '*': [('/', 'times_over')],
          '/': [('*', 'over_times')], '%': [('/', 'modulo_over')],
          '<': [('<=', 'less_upto'), ('>=', 'less_not')], '>': [('>=', 'more_from'), ('<=', 'more_not')],
          '<=': [('<', 'upto_less'), ('>', 'upto_not')], '>=': [('>', 'from_more'), ('<', 'from_not')],
          '==': [('!=', 'same_other')], '!=': [('==', 'other_same')]}


@dataclasses.dataclass
class Token:
    kind: str
    text: str
    start: int
    depth: int = 0
    partner: int = -1  # index of the matching bracket
    silent: bool = False  # true in code that must not be changed

    @property
    def end(self):
        return self.start + len(self.text)


@dataclasses.dataclass
class Change:
    file: str
    start: int
    end: int
    text: str  # plain form: text that replaces start..end
    edits: list  # switched form: list of (start, end, text with {n}); empty if there is none
    line: int = 0
    source: str = ''
    shown: str = ''
    number: int = 0
    const_at: int = -1  # position of a constexpr that becomes const in the switched form

    @property
    def key(self):
        return f'{self.file} | {self.source} | {self.shown}'


def tokens_of(text):
    text = re.sub(r'^[ \t]*#(?:[^\n]*\\\n)*[^\n]*', lambda m: re.sub(r'[^\n]', ' ', m.group()), text, flags=re.M)
    found, at = [], 0
    while at < len(text):
        match = TOKEN.match(text, at)
        at = match.end()
        if match.lastgroup == 'tag' or match.group('raw'):
            found.append(Token('string', match.group(), match.start()))
        elif match.lastgroup not in ('space', 'comment'):
            found.append(Token(match.lastgroup, match.group(), match.start()))
    stack = []
    for i, token in enumerate(found):
        if token.kind == 'sign' and token.text in CLOSES and stack:
            token.partner = stack.pop()
            found[token.partner].partner = i
        token.depth = len(stack)
        token.silent = any(found[s].silent for s in stack[-1:])
        if token.kind == 'sign' and token.text in OPENS:
            if i and found[i - 1].text in TALKS:
                token.silent = True
            stack.append(i)
    return found


def spaced(text, token):
    return text[token.start - 1].isspace() and text[token.end].isspace()


def rest_of_operand(tokens, i, ends):
    """Returns the index after the operand that begins at i. This is the first of `ends` at the same depth, or a
    closing bracket."""
    depth = tokens[i].depth
    while i < len(tokens):
        token = tokens[i]
        if token.kind == 'sign' and (token.depth < depth or token.depth == depth and token.text in ends):
            return i
        i = token.partner + 1 if token.text in OPENS and token.partner > i else i + 1
    return i


class Finder:
    def __init__(self, file, text):
        self.file, self.text, self.tokens, self.found = file, text, tokens_of(text), []
        self.starts = {i for i in range(1, len(self.tokens)) if self.begins_statement(i)}

    def add(self, first, last, shown, plain, edits):
        """Adds a change. first..last: the tokens that the plain form replaces. shown: the description of these
        tokens."""
        t = self.tokens
        change = Change(self.file, t[first].start, t[last].end, plain, edits)
        change.line = self.text.count('\n', 0, change.start) + 1
        change.source = self.text.split('\n')[change.line - 1].strip()
        before = ' '.join(x.text for x in t[max(0, first - 2):first])
        after = ' '.join(x.text for x in t[last + 1:last + 3])
        change.shown = f'{before} [{shown}] {after}'.strip()
        begin = first
        while begin > 0 and t[begin - 1].text not in (';', '{', '}') or t[begin - 1].text in ('{', '}') and t[begin].depth > 0 and t[begin - 1].partner >= 0 and self.in_initialiser(begin - 1):
            begin -= 1
        for k in range(begin, min(begin + 3, first)):
            if t[k].text == 'constexpr':
                change.const_at = t[k].start
        self.found.append(change)

    def in_initialiser(self, brace):
        t = self.tokens
        opening = brace if t[brace].text == '{' else t[brace].partner
        return opening > 0 and (t[opening - 1].text in ('=', ',', '(', '{', ']') or t[opening - 1].kind == 'word'
                                and t[opening - 1].text not in ('else', 'const', 'do', 'try', 'override', 'noexcept')
                                and t[opening - 2].text not in ('struct', 'namespace', 'class', 'enum'))

    def begins_statement(self, i):
        t, before = self.tokens, self.tokens[i - 1]
        if before.text in (';', '}', 'else'):
            return True
        if before.text == '{':
            return not self.in_initialiser(i - 1)
        if before.text == ')' and before.partner > 0:
            return t[before.partner - 1].text in ('if', 'for', 'while')
        return False

    def find(self):
        for i, token in enumerate(self.tokens):
            if i == 0 or i + 1 >= len(self.tokens) or token.silent or token.depth == 0 and token.kind != 'number':
                continue
            if token.kind == 'number':
                self.number(i)
            elif token.kind == 'sign':
                self.sign(i)
            elif token.text in ('true', 'false'):
                other = 'false' if token.text == 'true' else 'true'
                self.add(i, i, f'{token.text} -> {other}', other,
                         [(token.start, token.end, f'::mutate::pick({{n}}, {other}, {token.text})')])
            elif token.text in ('max', 'min') and self.tokens[i + 1].text == '(' and self.tokens[i - 2].text == 'std':
                self.extremum(i)
            elif token.text == 'if':
                self.condition(i)
            elif token.text in ('front', 'back') and self.tokens[i - 1].text == '.':
                other = 'back' if token.text == 'front' else 'front'
                self.add(i, i, f'{token.text} -> {other}', other, [])
            if i in self.starts:
                self.statement(i)
        return self.found

    def number(self, i):
        t = self.tokens[i]
        if self.tokens[i - 1].text in ('<', '"', 'case') or "'" in t.text or self.tokens[i - 1].text == '[' and self.tokens[i - 2].kind != 'word':
            return
        digits = t.text.rstrip('uUlLfzZ') if not t.text.startswith(('0x', '0X')) else re.sub('[uUlLzZ]+$', '', t.text)
        suffix = t.text[len(digits):]
        if re.fullmatch(r'0[xX][0-9a-fA-F]+', digits):
            options = [hex(int(digits, 16) + 1)]
        elif re.fullmatch(r'\d+', digits):
            n = int(digits)
            options = [str(n + 1)] + ([str(n - 1)] if n > 0 else [])
        else:
            value = float(digits)
            options = ['1.0'] if value == 0 else [repr(value * 1.1), repr(value * 2)]
        for other in options:
            other += suffix
            self.add(i, i, f'{t.text} -> {other}', other,
                     [(t.start, t.end, f'::mutate::pick({{n}}, {other}, {t.text})')])

    def sign(self, i):
        t, token = self.tokens, self.tokens[i]
        before, after = t[i - 1], t[i + 1]
        if token.text in BINARY and spaced(self.text, token):
            if 'string' in (before.kind, after.kind) or before.text in ('template', 'operator', ','):
                return
            for other, kind in BINARY[token.text]:
                self.add(i, i, f'{token.text} -> {other}', other,
                         [(token.start, token.end, f'{token.text} ::mutate::{kind}{{{{{{n}}}}}} {token.text}')])
        elif token.text == '-' and not spaced(self.text, token) and (before.kind == 'sign' and before.text not in (')', ']') or before.text == 'return'):
            edits = [] if before.text in ('*', '/', '%') else [(token.start, token.end, '::mutate::sign({n}) * ')]
            self.add(i, i, '- -> ', '', edits)
        elif token.text in ('&&', '||') and spaced(self.text, token):
            end = rest_of_operand(t, i + 1, {'&&', '||', '?', ':', ',', ';', '=', '}'})
            opening = '(::mutate::on({n}) || (' if token.text == '&&' else '(!::mutate::on({n}) && ('
            what = self.text[after.start:t[end - 1].end]
            self.add(i, end - 1, f'{token.text} {shorten(what)} -> ', '',
                     [(after.start, after.start, opening), (t[end - 1].end, t[end - 1].end, '))')])
        elif token.text in ('+=', '-=', '*=', '/='):
            other = {'+=': '-=', '-=': '+=', '*=': '/=', '/=': '*='}[token.text]
            end = rest_of_operand(t, i + 1, {',', ';'})
            opening = '::mutate::flip({n}) * (' if token.text in ('+=', '-=') else '::mutate::inverse({n}, ('
            closing = ')' if token.text in ('+=', '-=') else '))'
            self.add(i, i, f'{token.text} -> {other}', other,
                     [(after.start, after.start, opening), (t[end - 1].end, t[end - 1].end, closing)])
        elif token.text == '[' and before.kind in ('word',) and before.text not in KEYWORDS or token.text == '[' and before.text in (')', ']'):
            last = token.partner - 1
            if last <= i or last == i + 1 and t[last].kind == 'number' or after.kind == 'string':
                return
            for by in (1, -1):
                shown = f'[{self.text[after.start:t[last].end]}] {by:+d}'
                self.add(i + 1, last, shown, f'{self.text[after.start:t[last].end]} {"+-"[by < 0]} 1',
                         [(after.start, after.start, '::mutate::shift({n}, ('),
                          (t[last].end, t[last].end, f'), {by})')])

    def extremum(self, i):
        name = self.tokens[i].text
        other, planted = ('min', 'larger') if name == 'max' else ('max', 'smaller')
        opening, std = self.tokens[i + 1], self.tokens[i - 2]
        self.add(i, i, f'{name} -> {other}', other,
                 [(std.start, opening.end, f'::mutate::{planted}({{n}}, ')] if self.tokens[i + 2].text != '{' else [])

    def condition(self, i):
        t = self.tokens
        if t[i + 1].text != '(' or t[i + 2].text in ('const', 'auto'):
            return
        first, last = i + 2, t[i + 1].partner - 1
        if any(x.text == ';' for x in t[first:last]):
            return
        inside = self.text[t[first].start:t[last].end]
        self.add(first, last, f'{shorten(inside)} negated', f'!({inside})',
                 [(t[first].start, t[first].start, '::mutate::on({n}) != static_cast<bool>('),
                  (t[last].end, t[last].end, ')')])

    def statement(self, i):
        t = self.tokens
        end = rest_of_operand(t, i, {';'})
        if end >= len(t) or t[end].text != ';' or end == i:
            return
        words = t[i:end]
        if t[i].text in ('continue', 'break') and len(words) == 1:
            pass
        elif t[i].kind != 'word' and t[i].text not in ('++', '--', '*') or t[i].text in KEYWORDS | TALKS | {'MDOF_TRY', 'continue', 'break'}:
            return
        else:
            level = [w for w in words if w.depth == t[i].depth]
            assigns = [k for k, w in enumerate(level) if w.text in ('=', '+=', '-=', '*=', '/=', '|=', '&=', '^=')]
            head = level[:assigns[0]] if assigns else level
            if any(a.kind == 'word' and b.kind == 'word' or a.text in ('>', '&', '*') and b.kind == 'word' and not spaced(self.text, a)
                   for a, b in zip(head, head[1:])):
                return  # this is a declaration
            if not assigns and words[-1].text != ')' and t[i].text not in ('++', '--') and words[-1].text not in ('++', '--'):
                return
        what = self.text[t[i].start:t[end].end]
        if '.reserve(' in what:
            return
        self.add(i, end, f'{shorten(what)} dropped', ';',
                 [(t[i].start, t[i].start, '{{ if (!::mutate::on({n})) {{ '), (t[end].end, t[end].end, ' }} }}')])


def shorten(text):
    text = ' '.join(text.split())
    return text if len(text) <= 60 else text[:57] + '...'


def changes_of(file, text):
    return Finder(file, text).find()


def planted(text, changes, header='mutate_switch.h'):
    """Returns the text with the switched forms of all `changes`. All changes are in one file, and each is at one
    place at most once."""
    edits = []
    for change in changes:
        size = change.edits[-1][1] - change.edits[0][0] if change.edits else 0
        for k, (start, end, new) in enumerate(change.edits):
            # Order of the edits at one place: first closing texts, the inner text before the outer; then opening
            # texts, the outer text before the inner; then replacements.
            if end > start:
                order = (start, 2, 0, 0)
            elif k == 1:
                order = (start, 0, size, -change.number)
            else:
                order = (start, 1, -size, change.number)
            edits.append((order, start, end, new.format(n=change.number)))
        if change.const_at >= 0:
            order = (change.const_at, 2, 0, 0)
            edits.append((order, change.const_at, change.const_at + len('constexpr'), 'const    '))
    out, at = [], 0
    for _, start, end, new in sorted(set(edits)):
        if start < at:
            continue
        out += [text[at:start], new]
        at = end
    body = ''.join(out) + text[at:]
    return f'#include "{header}"\n#line 1\n{body}' if edits else body
