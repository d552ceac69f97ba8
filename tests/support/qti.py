"""What is legal in QTI 2.1, and the response processing of an item: the score of an answer and the
replies shown.

It covers what exported questions use (information model of QTI 2.1, section 8).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from lxml import etree
from support.little_book import FIXTURES

QTI = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"
type Value = float | str | list[str] | bool | None


def illegal_parts(package: Mapping[str, str]) -> dict[str, str]:
    """What the schemas do not allow, by the file of the package."""
    schema = etree.DTD(FIXTURES / "qti-2.1.dtd")
    items = {name: text.encode() for name, text in package.items() if name != "imsmanifest.xml"}
    return {
        name: str(schema.error_log.last_error)
        for name, text in items.items()
        if not schema.validate(etree.fromstring(text))
    }


@dataclass(slots=True)
class Session:
    """One attempt at an item."""

    item: Element
    variables: dict[str, Value] = field(default_factory=dict)

    @property
    def score(self) -> Value:
        return self.variables["SCORE"]

    @property
    def replies(self) -> list[str]:
        """The texts of the chosen replies, in the order of the item."""
        chosen = self.variables.get("FEEDBACK")
        names = chosen if isinstance(chosen, list) else [chosen]
        return [
            " ".join("".join(reply.itertext()).split())
            for reply in self.item.iter(f"{QTI}modalFeedback")
            if reply.get("identifier") in names
        ]


def session_after(item: str, answer: Value) -> Session:
    """The session after ``answer`` was given to ``item``, the text of an XML file."""
    session = Session(ElementTree.fromstring(item), {"RESPONSE": answer, "SCORE": 0.0})
    for rule in session.item.findall(f"{QTI}responseProcessing/*"):
        _apply(rule, session)
    return session


def _apply(rule: Element, session: Session) -> bool:
    """Whether the rule is a branch that was taken."""
    match rule.tag.removeprefix(QTI):
        case "setOutcomeValue":
            session.variables[rule.get("identifier", "")] = _value(rule[0], session)
        case "responseCondition":
            any(_apply(branch, session) for branch in rule)
        case "responseIf" | "responseElseIf":
            if _value(rule[0], session) is not True:
                return False
            for each in rule[1:]:
                _apply(each, session)
        case "responseElse":
            for each in rule:
                _apply(each, session)
        case other:
            raise NotImplementedError(other)
    return True


def _value(expression: Element, session: Session) -> Value:
    operands = [_value(each, session) for each in expression]
    match expression.tag.removeprefix(QTI):
        case "variable":
            return session.variables[expression.get("identifier", "")]
        case "correct":
            return _correct(session.item)
        case "baseValue":
            text = expression.text or ""
            return float(text) if expression.get("baseType") == "float" else text
        case "match":
            first, second = operands
            if isinstance(first, list) and _cardinality(session.item) == "multiple":
                return isinstance(second, list) and sorted(first) == sorted(second)
            return first == second
        case "mapResponse":
            return _mapped(session)
        case "not":
            return not operands[0]
        case "isNull":
            return operands[0] is None
        case "index":
            (sequence,) = operands
            return sequence[int(expression.get("n", "")) - 1] if sequence else None  # type: ignore[index]
        case "equal":
            first, second = operands
            if not isinstance(first, float) or not isinstance(second, float):
                return None
            below, above = map(float, expression.get("tolerance", "").split())
            return second - below <= first <= second + above
        case other:
            raise NotImplementedError(other)


def _mapped(session: Session) -> float:
    (mapping,) = session.item.iter(f"{QTI}mapping")
    worth = {e.get("mapKey"): float(e.get("mappedValue", "")) for e in mapping}
    given = session.variables["RESPONSE"]
    chosen = given if isinstance(given, list) else []
    total = sum(worth.get(key, float(mapping.get("defaultValue", ""))) for key in chosen)
    least, most = (float(mapping.get(name, "")) for name in ("lowerBound", "upperBound"))
    return min(max(total, least), most)


def _correct(item: Element) -> Value:
    (declared,) = item.iter(f"{QTI}responseDeclaration")
    values = [value.text or "" for value in declared.iter(f"{QTI}value")]
    if _cardinality(item) != "single":
        return values
    return float(values[0]) if declared.get("baseType") == "float" else values[0]


def _cardinality(item: Element) -> str:
    (declared,) = item.iter(f"{QTI}responseDeclaration")
    return declared.get("cardinality", "")
