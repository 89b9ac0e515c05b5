import { element } from "./element.js";

function download(name, text) {
  const href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  const link = element("a", { download: name, href });
  link.click();
  URL.revokeObjectURL(href);
}

function copyButton(text) {
  const button = element("button", { text: "Copy the command" });
  button.addEventListener("click", async () => {
    await navigator.clipboard?.writeText(text);
    button.textContent = "Copied";
  });
  return button;
}

const fileText = ({ path, bytes, crc32 }) => `${path}: ${bytes} bytes, CRC-32 ${crc32}`;

export const reproduce = {
  id: "reproduce",
  title: "How to reproduce",
  build(place, { data, result, command }) {
    const { program, command_line: line, files } = data.origin;
    const save = element("button", { className: "primary", id: "download", text: "Download the result (JSON)" });
    save.addEventListener("click", () => download(`${command}.json`, `${JSON.stringify(result, null, 2)}\n`));
    place.append(element("pre", {}, element("code", { text: line })),
      element("ul", {}, ...files.map((file) => element("li", { text: fileText(file) }))),
      element("p", { className: "muted", text: `${program}. The CRC-32 is that of zlib and gzip.` }),
      element("p", { className: "buttons" }, save, copyButton(line)));
  },
};
