// Elements without markup: whatever is a name stays text.

type Child = Node | string;
export type Attributes = Record<string, string | number | boolean | undefined | ((event: Event) => void)>;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined) made.setAttribute(name, String(value));
  }
  made.append(...children);
  return made;
}

export function byId(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element ${id}`);
  return found;
}

export function setText(node: Element, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

export function setAttribute(node: Element, name: string, value: string | null): void {
  if (value === null) node.removeAttribute(name);
  else if (node.getAttribute(name) !== value) node.setAttribute(name, value);
}

/// Rows of a list that stay the same elements while their item is there, so that focus does.
export class KeyedList<Item> {
  private readonly rows = new Map<string, HTMLElement>();

  constructor(
    private readonly container: HTMLElement,
    private readonly make: (item: Item) => HTMLElement,
    private readonly update: (row: HTMLElement, item: Item) => void,
    private readonly empty: () => string,
  ) {}

  show(items: Item[], key: (item: Item) => string): void {
    const wanted = new Set(items.map(key));
    for (const [name, row] of this.rows) {
      if (wanted.has(name)) continue;
      row.remove();
      this.rows.delete(name);
    }
    for (const text of this.container.querySelectorAll(":scope > .empty")) text.remove();
    let place: Element | null = this.container.firstElementChild;
    for (const item of items) {
      let row = this.rows.get(key(item));
      if (!row) {
        row = this.make(item);
        this.rows.set(key(item), row);
      }
      this.update(row, item);
      if (row === place) place = place.nextElementSibling;
      else this.container.insertBefore(row, place);
    }
    if (items.length === 0 && this.empty() !== "") this.container.append(element("p", { class: "empty" }, this.empty()));
  }

  clear(): void {
    this.rows.clear();
    this.container.replaceChildren();
  }
}

export function button(label: string, act: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return element("button", { type: "button", click: act, ...attributes }, label);
}
