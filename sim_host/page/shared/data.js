/** What the program wrote into the page. */
export function pageData() {
  return JSON.parse(document.getElementById("data").textContent);
}
